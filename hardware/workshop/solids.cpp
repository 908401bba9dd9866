// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/solids.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/units.hpp"

namespace carpus::hardware {
namespace {

/// A closed outline of radius and height turned about z; a radius of 0 is a pole.
TriangleMesh lathe(const std::vector<std::pair<double, double>>& outline, int sides) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  std::vector<std::uint32_t> first;
  for (const auto& [radius, height] : outline) {
    first.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    for (std::uint32_t i = 0; i < (radius > 0 ? n : 1); ++i) {
      const double turn = 2 * kPi * i / n;
      mesh.vertices.push_back({radius * std::cos(turn), radius * std::sin(turn), height});
    }
  }
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const std::size_t next = (k + 1) % outline.size();
    const bool is_pole = !(outline[k].first > 0);
    const bool is_next_pole = !(outline[next].first > 0);
    if (is_pole && is_next_pole) continue;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      const std::uint32_t a = first[k] + (is_pole ? 0 : i);
      const std::uint32_t b = first[k] + (is_pole ? 0 : j);
      const std::uint32_t c = first[next] + (is_next_pole ? 0 : i);
      const std::uint32_t d = first[next] + (is_next_pole ? 0 : j);
      if (!is_pole) mesh.facets.push_back({a, b, d});
      if (!is_next_pole) mesh.facets.push_back({a, d, c});
    }
  }
  return mesh;
}

}  // namespace

Place at(const Vec3& translation) { return {Mat3::identity(), translation}; }

Place turned(const Vec3& axis, double degrees) {
  return {rotation_about(axis, radians_from_degrees(degrees)), {}};
}

Place along(const Vec3& from, const Vec3& to) {
  const Vec3 z = normalized_or(to - from, {0, 0, 1});
  const Vec3 x = any_perpendicular(z);
  return {Mat3::from_columns(x, cross(z, x), z), from};
}

TriangleMesh moved(const TriangleMesh& mesh, const Place& place) {
  TriangleMesh result = mesh;
  for (Vec3& vertex : result.vertices) vertex = place * vertex;
  return result;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.facets)
    mesh.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
}

TriangleMesh box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z});
  }
  mesh.facets = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh cylinder(double radius, double low, double high, int sides) {
  return lathe({{0, low}, {radius, low}, {radius, high}, {0, high}}, sides);
}

TriangleMesh ring(double inner, double outer, double low, double high, int sides) {
  return lathe({{inner, low}, {outer, low}, {outer, high}, {inner, high}}, sides);
}

TriangleMesh ball(double radius, int sides) {
  std::vector<std::pair<double, double>> outline;
  const int half = sides / 2;
  for (int i = 0; i <= half; ++i) {
    const double turn = kPi * i / half;
    const bool is_end = i == 0 || i == half;
    outline.emplace_back(is_end ? 0 : radius * std::sin(turn), -radius * std::cos(turn));
  }
  return lathe(outline, sides);
}

}  // namespace carpus::hardware
