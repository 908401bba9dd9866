// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Iso-surface of a scalar grid as a closed triangle mesh.
#pragma once

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// Crossings nearer to a voxel centre than this fraction of the edge are moved there, so that a
/// value equal to `iso` makes small triangles, not points. 1/1024 of a 0.5 mm voxel is 0.5 um,
/// far below what a CT resolves, and still many steps of the float positions that viewers use.
inline constexpr double kLeastEdgeFraction = 1.0 / 1024.0;

struct MarchingCubesOptions {
  /// True: the grid is taken to be surrounded by outside, so that a body which reaches the border
  /// is cut off half a voxel beyond its last voxel centres and the surface is closed. False: the
  /// surface ends at the border.
  bool close_at_border = true;
};

/// The surface where `values` crosses `iso`. The body is where value >= iso (NaN counts as
/// outside); triangles are counter-clockwise seen from the lower values, for grids of either
/// handedness.
///
/// @param values  scalars on a grid with any spacing and direction.
/// @return vertices in frame Patient [mm]. With close_at_border the mesh is always a closed,
///     oriented 2-manifold (check_surface is Ok), whatever the values; empty when nothing is
///     inside. Bodies that touch along an edge or corner of the grid stay apart.
/// @throws InvalidInput if iso is not finite or the grid has an empty side.
/// Source: [lorensen1987marching], with the table of cube_table.hpp.
[[nodiscard]] TriangleMesh extract_isosurface(const GridView<const float>& values,
                                              double iso,
                                              const MarchingCubesOptions& options = {});

}  // namespace carpus::mesh
