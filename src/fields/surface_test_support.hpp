// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Closed test surfaces with hollows, and poses, for the tests of contact with true surfaces.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/rng.hpp"
#include "core/units.hpp"
#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::fields::test {

/// A ring about z: the hole takes a wire, the saddle inside it touches it on two sides.
[[nodiscard]] inline TriangleMesh torus(double ring_radius_mm, double tube_radius_mm, int n) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 2 * kPi * i / n;
      const double v = 2 * kPi * j / n;
      const double r = ring_radius_mm + tube_radius_mm * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), tube_radius_mm * std::sin(v)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * n + j % n); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// A body of revolution about z with a bowl pressed into its top, like the fossa of the radius:
/// 20 mm across, the bowl 14 mm wide and 3 mm deep.
[[nodiscard]] inline TriangleMesh bowl(int n) {
  // Outline from the bottom's middle to the bowl's middle: radius, height.
  std::vector<std::pair<double, double>> outline;
  const int few = n / 4;
  const auto part = [&](int i) { return static_cast<double>(i) / few; };
  for (int i = 1; i < few; ++i) outline.emplace_back(10 * part(i), -8);
  for (int i = 0; i < few; ++i) outline.emplace_back(10, -8 + 10 * part(i));
  for (int i = 0; i < few; ++i) {  // the rim, round
    outline.emplace_back(8.5 + 1.5 * std::cos(kPi * part(i)), 2 + 1.5 * std::sin(kPi * part(i)));
  }
  for (int i = few; i > 0; --i) outline.emplace_back(7 * part(i), -1 + 3 * part(i) * part(i));
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, -8});
  for (const auto& [r, z] : outline) {
    for (int i = 0; i < n; ++i) {
      const double a = 2 * kPi * i / n;
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  }
  mesh.vertices.push_back({0, 0, -1});
  const int rings = static_cast<int>(outline.size());
  const auto at = [&](int ring, int i) { return static_cast<std::uint32_t>(1 + ring * n + i % n); };
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int i = 0; i < n; ++i) {
    mesh.facets.push_back({0, at(0, i + 1), at(0, i)});
    mesh.facets.push_back({top, at(rings - 1, i), at(rings - 1, i + 1)});
    for (int r = 0; r + 1 < rings; ++r) {
      mesh.facets.push_back({at(r, i), at(r, i + 1), at(r + 1, i + 1)});
      mesh.facets.push_back({at(r, i), at(r + 1, i + 1), at(r + 1, i)});
    }
  }
  return mesh;
}

/// A block with its edges along the axes.
[[nodiscard]] inline TriangleMesh box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z});
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

[[nodiscard]] inline TriangleMesh box(const Vec3& half) { return box(-half, half); }

[[nodiscard]] inline Vec3 random_direction(Rng& rng) {
  while (true) {
    const Vec3 v{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const double n = squared_length(v);
    if (n > 1e-3 && n <= 1) return v / std::sqrt(n);
  }
}

/// Some way in some direction, drawn in this order in every build (arguments have none).
[[nodiscard]] inline Vec3 random_shift(Rng& rng, double most_mm) {
  const Vec3 direction = random_direction(rng);
  return direction * rng.uniform(0, most_mm);
}

/// Any rotation; +z of the tool goes to `shaft`.
[[nodiscard]] inline Mat3 turned_to(const Vec3& shaft) {
  const Vec3 x = any_perpendicular(shaft);
  return Mat3::from_columns(x, cross(shaft, x), shaft);
}

}  // namespace carpus::fields::test
