// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What one sweep over the points tells: the farthest in a few directions, and whether all
// coordinates are in range.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/vec3.hpp"

namespace carpus::hull {

struct ExtremePoints {
  /// Index of a point that is least and one that is greatest (rounded) along x, y, z and the
  /// diagonals (1, 1, 1), (1, 1, -1), (1, -1, 1), (1, -1, -1).
  std::array<std::uint32_t, 14> index{};
  Vec3 low;  ///< of the bounding box
  Vec3 high;
  bool are_in_range = false;  ///< finite, at most kLargestCoordinate, 0 or at least the smallest
};

/// @param points  at least one. Where `are_in_range` is false the rest is unspecified. O(n).
[[nodiscard]] ExtremePoints find_extremes(std::span<const Vec3> points);

}  // namespace carpus::hull
