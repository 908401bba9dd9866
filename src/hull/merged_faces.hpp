// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A convex polytope with polygons for faces.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/convex_polytope.hpp"

namespace carpus::hull {

/// One face: all facets of one plane together.
struct PolygonalFace {
  std::vector<std::uint32_t> corners;     ///< vertices of the polytope, counter-clockwise outside
  std::vector<std::uint32_t> neighbours;  ///< [i]: face across the edge from corner i to i + 1
  std::vector<std::uint32_t> facets;      ///< its triangles, ascending
};

/// Faces in the order of their first facet; coplanar (exactly) neighbours are one.
/// V - E + F = 2 with E half the number of corners of all faces. O(facets).
/// @param polytope  a HullResult's: each vertex is a corner.
[[nodiscard]] std::vector<PolygonalFace> merged_faces(const ConvexPolytope& polytope);

}  // namespace carpus::hull
