// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Large point sets for tests; the wheel's hull has vertices joined to nearly all others.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/rng.hpp"
#include "geometry/vec3.hpp"

namespace carpus::hull {

/// `count` points: normal, spherical, or one of two lattices, by seed.
[[nodiscard]] inline std::vector<Vec3> large_points(std::uint64_t seed, std::size_t count) {
  Rng rng(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    p = {rng.normal(), rng.normal(), rng.normal()};
    if (seed % 4 == 1) p = normalized_or(p, {1, 0, 0});
    const auto lattice = [&](std::uint64_t n) { return static_cast<double>(rng.below(n)); };
    if (seed % 4 == 2) p = {0.3 * lattice(30), 0.3 * lattice(30), 0.5 * lattice(30)};
    if (seed % 4 == 3) p = {lattice(60), lattice(60), lattice(2)};
  }
  return points;
}

/// A ring of `count` points, nearly in one plane, and two apexes above and below.
[[nodiscard]] inline std::vector<Vec3> wheel(std::size_t count) {
  Rng rng(7);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    points.push_back({std::cos(angle), std::sin(angle), 1e-9 * rng.uniform(-1, 1)});
  }
  points.push_back({0, 0, 1});
  points.push_back({0, 0, -1});
  return points;
}

}  // namespace carpus::hull
