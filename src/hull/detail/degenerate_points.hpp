// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Small point sets for the tests of hull algorithms, most of them degenerate as voxels make them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "geometry/vec3.hpp"

namespace carpus::hull {

/// Point sets of many kinds, most of them degenerate, as voxels make them.
[[nodiscard]] inline std::vector<Vec3> random_points(std::uint64_t seed) {
  Rng rng(seed);
  const std::uint64_t kind = rng.below(8);
  const std::uint64_t count = 4 + rng.below(kind == 7 ? 400 : 60);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto lattice = [&](std::uint64_t n) { return static_cast<double>(rng.below(n)); };
    Vec3 p{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (kind == 0) p = {lattice(3), lattice(3), lattice(3)};  // duplicates, full lattices
    if (kind == 1) p = {0.4 * lattice(7), 0.5 * lattice(7), 0.9 * lattice(7)};  // CT spacing
    if (kind == 2) p = normalized_or(p, {1, 0, 0});    // nearly cospherical
    if (kind == 3) p = {lattice(2) * 1e-9, p.y, p.z};  // two close planes
    if (kind == 4) {  // exactly cospherical: permutations of (+-2, +-3, +-6), |p| = 7
      const std::array<double, 3> c{2, 3, 6};
      const std::uint64_t shift = rng.below(3);
      for (std::size_t a = 0; a < 3; ++a) {
        p[a] = (rng.below(2) == 0 ? 1 : -1) * c[(a + shift) % 3];
      }
    }
    if (kind == 5) p = {std::round(p.x * 4), std::round(p.y * 4), (p.x + p.y) * 1e-15};  // slivers
    if (kind == 6 && i > 3) {  // on edges and faces of what is there already
      const Vec3& a = points[rng.below(points.size())];
      const Vec3& b = points[rng.below(points.size())];
      p = a + (b - a) * 0.5;
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace carpus::hull
