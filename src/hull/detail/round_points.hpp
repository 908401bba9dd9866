// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Large point sets for tests whose hull has vertices joined to nearly all others.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/rng.hpp"
#include "geometry/vec3.hpp"

namespace carpus::hull {

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
