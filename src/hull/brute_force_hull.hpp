// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex hull by trying every plane: the thesis's first algorithm [yaacoub2008] §4.2.
#pragma once

#include <span>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// The same result as build_convex_hull, from every triple of points whose plane has all others on
/// one side. Cost: O(n^4); for hundreds of points at most.
[[nodiscard]] HullResult build_hull_by_brute_force(std::span<const Vec3> points,
                                                   const HullOptions& options = {});

}  // namespace carpus::hull
