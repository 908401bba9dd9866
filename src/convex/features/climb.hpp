// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The extreme vertex along a direction, by climbing along edges.
#pragma once

#include <cstdint>

#include "convex/features/voronoi_features.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// The vertex farthest along `direction`, given in the body's own coordinates; from `start`. On a
/// convex body the best of neighbours is the best of all.
[[nodiscard]] inline std::uint32_t climb(const VoronoiFeatures& features,
                                         const Vec3& direction,
                                         std::uint32_t start) noexcept {
  std::uint32_t at = start;
  double best = dot(direction, features.vertex(at));
  for (std::uint32_t from = at;; from = at) {
    for (const VoronoiFeatures::Spoke& spoke : features.spokes(from)) {
      const double height = dot(direction, features.vertex(spoke.end));
      if (height > best) {
        best = height;
        at = spoke.end;
      }
    }
    if (at == from) return at;
  }
}

}  // namespace carpus::convex
