// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Axis-aligned bounding box.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "geometry/vec3.hpp"

namespace carpus {

/// Closed box [low, high]; starts empty (low > high), and an empty box overlaps nothing.
struct Aabb {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  constexpr void include(const Vec3& p) noexcept {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  constexpr void include(const Aabb& b) noexcept {
    if (b.is_empty()) return;
    include(b.low);
    include(b.high);
  }
  [[nodiscard]] constexpr bool is_empty() const noexcept { return !(low.x <= high.x); }
  [[nodiscard]] constexpr Aabb grown(double margin) const noexcept {
    const Vec3 m{margin, margin, margin};
    return {low - m, high + m};
  }
  [[nodiscard]] constexpr bool contains(const Vec3& p) const noexcept {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
           p.z <= high.z;
  }
  [[nodiscard]] constexpr bool overlaps(const Aabb& b) const noexcept {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
           low.z <= b.high.z && b.low.z <= high.z;
  }
  [[nodiscard]] constexpr Vec3 centre() const noexcept { return (low + high) * 0.5; }
  [[nodiscard]] constexpr Vec3 extent() const noexcept { return high - low; }
};

/// The smallest box around `points`.
[[nodiscard]] inline Aabb bounds_of(std::span<const Vec3> points) noexcept {
  Aabb box;
  for (const Vec3& p : points) box.include(p);
  return box;
}

}  // namespace carpus
