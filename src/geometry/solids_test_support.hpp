// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Random directions and rotations, and the corners of solids on which everything ties, for tests of
// hulls and of bodies.
#pragma once

#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "core/units.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::test {

/// Braces, so that the numbers are drawn in this order in every build.
[[nodiscard]] inline Vec3 random_vector(Rng& rng) {
  return {rng.normal(), rng.normal(), rng.normal()};
}
[[nodiscard]] inline Vec3 random_direction(Rng& rng) {
  return normalized_or(random_vector(rng), {1, 0, 0});
}
[[nodiscard]] inline Mat3 random_rotation(Rng& rng) {
  return rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal());
}

[[nodiscard]] inline std::vector<Vec3> box_points(const Vec3& half) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                      (i & 4) != 0 ? half.z : -half.z});
  }
  return points;
}

[[nodiscard]] inline std::vector<Vec3> octahedron_points(double r) {
  return {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
}

[[nodiscard]] inline std::vector<Vec3> prism_points(int sides, double radius, double half_length) {
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), half_length});
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), -half_length});
  }
  return points;
}

/// All lattice points within a radius: large flat faces, many of them parallel.
[[nodiscard]] inline std::vector<Vec3> lattice_ball_points(int radius) {
  std::vector<Vec3> points;
  for (int x = -radius; x <= radius; ++x) {
    for (int y = -radius; y <= radius; ++y) {
      for (int z = -radius; z <= radius; ++z) {
        if (x * x + y * y + z * z <= radius * radius) {
          points.push_back({double(x), double(y), double(z)});
        }
      }
    }
  }
  return points;
}

/// On an ellipsoid.
[[nodiscard]] inline std::vector<Vec3> round_points(Rng& rng, int count, const Vec3& radii) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 d = random_direction(rng);
    points.push_back({d.x * radii.x, d.y * radii.y, d.z * radii.z});
  }
  return points;
}

}  // namespace carpus::test
