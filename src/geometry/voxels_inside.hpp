// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which voxels a closed surface holds: the one rule for the sign of a distance and for a solid's
// voxels.
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus {

/// 1 for voxel centres about which the surface winds, 0 for others; a surface of several shells may
/// overlap itself. A centre on the surface counts as inside or outside, the same for all facets.
///
/// @param surface  closed and consistently oriented, in the grid's frame [mm].
/// @param grid  axes along those of the frame: its direction is the identity.
/// Cost: O(rows crossed * log + voxels).
[[nodiscard]] Grid<std::uint8_t> voxels_inside(const TriangleMesh& surface,
                                               const GridGeometry& grid);

}  // namespace carpus
