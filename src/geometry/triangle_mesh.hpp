// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Indexed triangle surface and its basic measures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus {

using Triangle = std::array<std::uint32_t, 3>;

/// Triangles over shared vertices [mm], counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> facets;
};

/// What is wrong with a surface, or that nothing is.
enum class SurfaceStatus {
  Ok,                 ///< closed, consistently oriented 2-manifold
  Empty,              ///< no facets
  IndexOutOfRange,    ///< a facet names a vertex that is not there, or one twice
  NotFinite,          ///< a vertex is NaN or infinite
  OpenOrNonManifold,  ///< an edge without exactly one twin of opposite direction
  PinchedVertex,      ///< the facets about a vertex form more than one fan
};

/// Checks that `mesh` is a closed, oriented 2-manifold; O(n log n).
[[nodiscard]] SurfaceStatus check_surface(const TriangleMesh& mesh);

/// Signed enclosed volume [mm^3], positive when facets face outwards.
[[nodiscard]] double volume_of(const TriangleMesh& mesh);

/// Total area of the facets [mm^2].
[[nodiscard]] double area_of(const TriangleMesh& mesh);

/// Centroid of the enclosed volume [mm]; for a closed surface with non-zero volume.
[[nodiscard]] Vec3 centroid_of(const TriangleMesh& mesh);

}  // namespace carpus
