// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What every hull algorithm asks of its input, and the four points that it may start from.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// Four points that span a tetrahedron, the last below the plane of the first three (orient3d < 0),
/// or the reason why there are none.
struct StartSimplex {
  HullStatus status = HullStatus::TooFewPoints;
  std::array<std::uint32_t, 4> corners{};
  Vec3 low;     ///< the least coordinate on each axis
  Vec3 extent;  ///< a bound on the coordinate differences of any two points, per axis
  /// The points that are farthest along the axes and the diagonals of the octants; some repeated.
  std::array<std::uint32_t, 14> extremes{};
};

/// Checks the coordinates and chooses far-apart points; O(n), in one sweep unless the points are
/// nearly flat.
[[nodiscard]] StartSimplex find_start_simplex(std::span<const Vec3> points,
                                              HullStatistics& statistics);

}  // namespace carpus::hull
