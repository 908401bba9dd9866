// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The thesis's hybrid [yaacoub2008] Algorithm 1: a double tetrahedron discards inner points, gift
// wrapping does the rest.
#pragma once

#include <span>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// The same result as build_convex_hull; statistics.points_discarded says how many points the first
/// stage removed. Cost: O(n + (n - discarded) h).
[[nodiscard]] HullResult build_hull_by_hybrid(std::span<const Vec3> points,
                                              const HullOptions& options = {});

}  // namespace carpus::hull
