// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of all labels of a volume in one sweep, without grey values.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

struct LabelSurface {
  std::uint16_t label = 0;
  TriangleMesh mesh;
};

/// For each label but 0, in rising order, the surface half-way between its voxels and all others:
/// what extract_isosurface finds at 0.5 in a grid of 1 where the label is and 0 elsewhere, closed
/// at the border, up to the order of vertices and facets. Where two labels touch, each has its own
/// surface in the same place.
/// @return vertices in frame Patient [mm]; every mesh is a closed, oriented 2-manifold.
/// @throws InvalidInput if the grid has an empty side.
/// Source: [lorensen1987marching], with the table of cube_table.hpp.
[[nodiscard]] std::vector<LabelSurface> extract_label_surfaces(
    const GridView<const std::uint16_t>& labels);

}  // namespace carpus::mesh
