// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the growth program and its proofs read of a body.
#pragma once

#include "collision/closest/support.hpp"
#include "collision/convex_body.hpp"
#include "collision/features/voronoi_features.hpp"
#include "collision/lp/polar_graph.hpp"

namespace carpus::collision {

/// A body's facets, and its vertices about the same origin.
struct ProofBody {
  const PolarGraph* facets = nullptr;
  const SupportGraph* corners = nullptr;
  const VoronoiFeatures* features = nullptr;

  ProofBody() = default;
  /// For set-up: see ConvexBody::derived().
  explicit ProofBody(const ConvexBody& body)
      : facets(&body.derived<PolarGraph>()),
        corners(&body.derived<SupportGraph>()),
        features(&body.derived<VoronoiFeatures>()) {}
};

}  // namespace carpus::collision
