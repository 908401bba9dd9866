// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/hull_from_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace carpus::case_io {
namespace {

/// A stored hull may bulge by rounding of its planes [mm]; a surface that is not convex by more.
constexpr double kConvexityToleranceMm = 1e-6;

auto key_of(const Vec3& p) { return std::tuple(p.x, p.y, p.z); }

/// For each vertex the index of the equal point; false where there is none.
bool find_inputs(std::span<const Vec3> points, ConvexPolytope& hull) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return key_of(points[a]) < key_of(points[b]);
  });
  for (const Vec3& v : hull.vertices) {
    const auto it = std::lower_bound(
        order.begin(), order.end(), v,
        [&](std::uint32_t a, const Vec3& p) { return key_of(points[a]) < key_of(p); });
    if (it == order.end() || !(points[*it] == v)) return false;
    hull.input_indices.push_back(*it);
  }
  return true;
}

void find_neighbours(ConvexPolytope& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> facet_of_edge;
  for (std::uint32_t f = 0; f < hull.facets.size(); ++f) {
    const Triangle& t = hull.facets[f];
    for (std::size_t i = 0; i < 3; ++i) facet_of_edge[{t[i], t[(i + 1) % 3]}] = f;
  }
  for (const Triangle& t : hull.facets) {
    hull.neighbours.push_back(
        {facet_of_edge[{t[1], t[0]}], facet_of_edge[{t[2], t[1]}], facet_of_edge[{t[0], t[2]}]});
  }
}

bool find_planes(ConvexPolytope& hull) {
  for (const Triangle& t : hull.facets) {
    const Vec3& a = hull.vertices[t[0]];
    const Vec3 normal =
        normalized_or(cross(hull.vertices[t[1]] - a, hull.vertices[t[2]] - a), Vec3{});
    if (normal == Vec3{}) return false;
    Plane plane{normal, dot(normal, a)};
    for (const Vec3& v : hull.vertices) {
      if (plane.signed_distance(v) > kConvexityToleranceMm) return false;
    }
    for (const Vec3& v : hull.vertices) plane.offset = std::max(plane.offset, dot(normal, v));
    hull.planes.push_back(plane);
  }
  return true;
}

}  // namespace

std::optional<ConvexPolytope> hull_from_mesh(const TriangleMesh& mesh,
                                             std::span<const Vec3> points) {
  if (check_surface(mesh) != SurfaceStatus::Ok) return std::nullopt;
  ConvexPolytope hull;
  hull.vertices = mesh.vertices;
  hull.facets = mesh.facets;
  if (!find_inputs(points, hull) || !find_planes(hull)) return std::nullopt;
  find_neighbours(hull);
  return hull;
}

}  // namespace carpus::case_io
