// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies for the tests of this folder: bone-like ones, and solids whose symmetries make ties.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "convex/convex_body.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "geometry/mat3.hpp"
#include "hull/quickhull.hpp"

namespace carpus::convex::lp_test {

[[nodiscard]] inline ConvexBody body_of(const std::vector<Vec3>& points) {
  return ConvexBody(hull::build_convex_hull(points).polytope);
}

[[nodiscard]] inline Vec3 any_direction(Rng& rng) {
  return normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
}

[[nodiscard]] inline Mat3 any_rotation(Rng& rng) {
  return rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal());
}

/// Points of a bumpy ellipsoid, as of a carpal bone, about a point off the frame's origin.
[[nodiscard]] inline ConvexBody pebble(Rng& rng, int points, const Vec3& centre = {3, -2, 5}) {
  std::vector<Vec3> cloud;
  const Vec3 bump = any_direction(rng);
  for (int i = 0; i < points; ++i) {
    const Vec3 d = any_direction(rng);
    const double r = 1 + 0.2 * dot(d, bump) * dot(d, bump) * dot(d, bump);
    cloud.push_back(centre + Vec3{9 * d.x, 6 * d.y, 5 * d.z} * r);
  }
  return body_of(cloud);
}

[[nodiscard]] inline ConvexBody box(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                       (i & 4) != 0 ? half.z : -half.z});
  }
  return body_of(corners);
}

[[nodiscard]] inline ConvexBody octahedron(double r) {
  return body_of({{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}});
}

[[nodiscard]] inline ConvexBody prism(int sides, double radius, double half_length) {
  std::vector<Vec3> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    for (const double z : {-half_length, half_length}) {
      corners.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  return body_of(corners);
}

/// All lattice points within a radius: large flat faces, many of them parallel.
[[nodiscard]] inline ConvexBody lattice_ball(int radius) {
  std::vector<Vec3> points;
  for (int x = -radius; x <= radius; ++x) {
    for (int y = -radius; y <= radius; ++y) {
      for (int z = -radius; z <= radius; ++z) {
        if (x * x + y * y + z * z <= radius * radius) {
          points.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  return body_of(points);
}

}  // namespace carpus::convex::lp_test
