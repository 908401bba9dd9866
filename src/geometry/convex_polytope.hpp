// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A convex body bounded by triangles: the level-1 type between `hull`, which builds it, and
// `collision`, which uses it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

/// Half-space normal . x <= offset; `normal` is a unit vector pointing out of the body.
struct Plane {
  Vec3 normal;
  double offset = 0.0;  ///< mm

  [[nodiscard]] constexpr double signed_distance(const Vec3& p) const noexcept {
    return dot(normal, p) - offset;
  }
};

/// Closed convex body with triangular facets, counter-clockwise from outside; F = 2V - 4.
struct ConvexPolytope {
  std::vector<Vec3> vertices;                ///< mm, each a corner of some facet
  std::vector<std::uint32_t> input_indices;  ///< vertices[i] was points[input_indices[i]]
  std::vector<Triangle> facets;              ///< indices into vertices
  std::vector<std::array<std::uint32_t, 3>>
      neighbours;             ///< [f][i]: facet across edge (i, i + 1) of f
  std::vector<Plane> planes;  ///< one per facet, rounded to double

  [[nodiscard]] TriangleMesh surface() const { return {vertices, facets}; }
};

}  // namespace carpus
