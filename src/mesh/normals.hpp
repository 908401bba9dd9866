// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertex normals for shading and for the direction of contact, from the field or from the facets.
#pragma once

#include <span>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// Unit normals towards lower values at `points_in_patient`, from central differences of the field
/// interpolated between voxels; Vec3{} where the field is flat or the point is outside the grid.
///
/// @param reach_mm  of the differences to either side, against noise; 0 for half a voxel
template <typename T>  // float, std::int16_t
[[nodiscard]] std::vector<Vec3> gradient_normals(const GridView<const T>& values,
                                                 std::span<const Vec3> points_in_patient,
                                                 double reach_mm = 0);

/// Unit outward normals of the vertices: facet normals weighted by the facet's angle at the vertex
/// [thurmer1998computing]; Vec3{} where all facets about a vertex are degenerate.
[[nodiscard]] std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

}  // namespace carpus::mesh
