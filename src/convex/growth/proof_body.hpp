// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the growth program and its proofs read of a body.
#pragma once

#include "convex/convex_body.hpp"
#include "convex/features/voronoi_features.hpp"
#include "convex/polar_graph.hpp"
#include "convex/support.hpp"

namespace carpus::convex {

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

}  // namespace carpus::convex
