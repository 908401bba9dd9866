// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The surface of one segmented bone, placed between voxels where the CT says it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "geometry/mesh_in.hpp"

namespace carpus::reconstruct {

struct BoneSurfaceOptions {
  double field_sigma_mm = 0.3;     ///< smoothing of the scalar field, about one voxel
  int smoothing_pairs = 6;         ///< of Taubin's filter
  double max_smoothing_mm = 0.25;  ///< no vertex is smoothed farther: half a slice of 0.5 mm
  double facets_per_mm2 = 6.0;     ///< 0.6 mm edges: finer than the CT resolves
  std::size_t least_facets = 3000;
  std::size_t most_facets = 10000;
  double max_error_mm = 0.08;  ///< of the simplification; a quarter of a voxel
};

/// Where a bone is, between voxels: positive inside, zero on its surface.
struct BoneField {
  Grid<float> values;  ///< on the bone's part of the segmented grid
  VoxelIndex offset;   ///< voxel of that grid at which the part begins
};

/// The field of region `label`.
///
/// @param labels  regions; another region's voxels are outside.
/// @param edge_excess  imaging::BoneSegmentation::edge_excess on the same grid: it crosses 0 where
///     the CT falls to half of the local cortex, which places the surface between the two voxels on
///     either side of the label's border.
/// @return empty if the label has no voxels.
[[nodiscard]] BoneField build_bone_field(const GridView<const std::uint8_t>& labels,
                                         std::uint8_t label,
                                         const GridView<const float>& edge_excess,
                                         const BoneSurfaceOptions& options = {});

/// Closed, outward surface of a bone [Patient, mm]: a closed, oriented 2-manifold of one piece; a
/// bone that leaves the grid is closed flat half a voxel beyond it. Empty for an empty field.
/// @param simplification_error_mm  where asked for: measured, how far the farthest vertex of the
///     surface before its simplification lies from the one after [mm]
[[nodiscard]] MeshIn<frame::Bone> build_bone_surface(const BoneField& field,
                                                     const BoneSurfaceOptions& options = {},
                                                     double* simplification_error_mm = nullptr);

/// Makes `labels` agree with the fields' surfaces: a voxel gets the bone inside whose surface its
/// centre lies (the deepest, should two claim it), or 0. `fields[i]` belongs to `label_of[i]`.
void label_by_fields(std::span<const BoneField> fields,
                     std::span<const std::uint8_t> label_of,
                     const GridView<std::uint8_t>& labels);

/// The connected piece of `mesh` with the greatest volume, without unused vertices.
[[nodiscard]] TriangleMesh largest_piece(const TriangleMesh& mesh);

}  // namespace carpus::reconstruct
