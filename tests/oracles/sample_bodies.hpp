// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Seeded bodies and poses for comparisons with an oracle: integer ones, for which arithmetic in
// long long is exact, and bone-like ones.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/check.hpp"
#include "core/rng.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/mat3.hpp"
#include "hull/quickhull.hpp"

namespace carpus::oracles {

inline ConvexPolytope hull_of(const std::vector<Vec3>& points) {
  hull::HullResult result = hull::build_convex_hull(points);
  CARPUS_CHECK(result.status == hull::HullStatus::Ok);
  return std::move(result.polytope);
}

/// Solids whose symmetries make ties: parallel facets, cospherical corners, right angles.
inline ConvexPolytope special_solid(std::uint64_t which) {
  std::vector<Vec3> points;
  const auto add = [&](double x, double y, double z) {
    for (int i = 0; i < 8; ++i) {
      points.push_back({(i & 1) != 0 ? x : -x, (i & 2) != 0 ? y : -y, (i & 4) != 0 ? z : -z});
    }
  };
  if (which == 0) add(4, 4, 4);
  if (which == 1) {
    add(5, 0, 0);
    add(0, 5, 0);
    add(0, 0, 5);
  }
  if (which == 2) add(1, 1, 12);  // a bar
  if (which == 3) {
    add(2, 3, 6);
    add(6, 2, 3);
    add(3, 6, 2);
  }
  return hull_of(points);
}

inline ConvexPolytope integer_body(Rng& rng) {
  if (rng.below(3) == 0) return special_solid(rng.below(4));
  while (true) {
    std::vector<Vec3> points;
    const std::uint64_t count = 4 + rng.below(16);
    const std::uint64_t range = 3 + rng.below(14);
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto c = [&] { return static_cast<double>(rng.below(range)); };
      points.push_back({c(), c(), c()});
    }
    hull::HullResult result = hull::build_convex_hull(points);
    if (result.status == hull::HullStatus::Ok) return std::move(result.polytope);
  }
}

/// One of the 24 rotations that permute the axes: exact in doubles.
inline Mat3 axis_rotation(Rng& rng) {
  while (true) {
    Mat3 m{};
    const std::uint64_t shift = rng.below(3);
    const bool swap = rng.below(2) == 0;
    for (std::size_t i = 0; i < 3; ++i) {
      m.rows[i] = {};
      std::size_t j = (i + shift) % 3;
      if (swap && j != 0) j = 3 - j;
      m.rows[i][j] = rng.below(2) == 0 ? 1 : -1;
    }
    if (m.determinant() > 0) return m;
  }
}

/// A bone-like hull: points of an ellipsoid, some 200 facets.
inline ConvexPolytope pebble(Rng& rng, int points) {
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) {
    const Vec3 p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
    cloud.push_back({9 * p.x, 6 * p.y, 5 * p.z});
  }
  return hull_of(cloud);
}

}  // namespace carpus::oracles
