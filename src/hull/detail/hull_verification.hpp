// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks a result against its contract, slowly and independently of how it was made; for tests and
// benchmarks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "geometry/predicates.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// Empty if `hull` is the convex hull of `points` in every detail of HullResult's contract, else
/// what is wrong. O(points * facets).
[[nodiscard]] inline std::string verify_hull(const ConvexPolytope& hull,
                                             std::span<const Vec3> points) {
  const std::size_t v = hull.vertices.size();
  const std::size_t f = hull.facets.size();
  if (check_surface(hull.surface()) != SurfaceStatus::Ok) return "not a closed manifold";
  if (f != 2 * v - 4) return "F is not 2V - 4";
  if (hull.input_indices.size() != v || hull.neighbours.size() != f || hull.planes.size() != f) {
    return "arrays of different lengths";
  }
  for (std::size_t i = 0; i < v; ++i) {
    if (hull.vertices[i] != points[hull.input_indices[i]]) return "a vertex is not its input point";
  }
  const auto corner = [&](std::size_t facet, std::size_t i) {
    return hull.vertices[hull.facets[facet][i % 3]];
  };
  for (std::size_t i = 0; i < f; ++i) {
    for (const Vec3& p : points) {
      if (orient3d(corner(i, 0), corner(i, 1), corner(i, 2), p) > 0) return "a point is outside";
    }
    for (std::size_t e = 0; e < 3; ++e) {
      const Triangle& t = hull.facets[hull.neighbours[i][e]];
      const std::uint32_t a = hull.facets[i][e];
      const std::uint32_t b = hull.facets[i][(e + 1) % 3];
      bool shared = false;
      for (std::size_t k = 0; k < 3; ++k) shared = shared || (t[k] == b && t[(k + 1) % 3] == a);
      if (!shared) return "a neighbour does not share its edge";
    }
  }
  // Corners only: three different supporting planes at each vertex.
  std::vector<std::vector<std::size_t>> planes_at(v);
  for (std::size_t i = 0; i < f; ++i) {
    for (const std::uint32_t w : hull.facets[i]) {
      bool is_new = true;
      for (const std::size_t other : planes_at[w]) {
        bool same = true;
        for (std::size_t k = 0; k < 3; ++k) {
          same = same &&
                 orient3d(corner(other, 0), corner(other, 1), corner(other, 2), corner(i, k)) == 0;
        }
        is_new = is_new && !same;
      }
      if (is_new) planes_at[w].push_back(i);
    }
  }
  for (const auto& planes : planes_at) {
    if (planes.size() < 3) return "a vertex is no corner";
  }
  return "";
}

}  // namespace carpus::hull
