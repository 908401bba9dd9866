// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From segmented and named bones to surfaces on the CT's edge, labels that agree with them, and
// what trust is judged by.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/bone_naming.hpp"
#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"
#include "imaging/bone_segmentation.hpp"
#include "reconstruct/bone_surface.hpp"
#include "reconstruct/bone_trust.hpp"

namespace carpus::reconstruct {

struct SurfacedBones {
  std::vector<TriangleMesh> surfaces;  ///< [Patient, mm], in the order of the labels asked for
  std::vector<BoneEvidence> evidence;  ///< of the bones as they were segmented
  /// As build_bone_surface measures it, in the order of the surfaces [mm].
  std::vector<double> simplification_error_mm;
};

/// Trust is measured on the surfaces before they are moved onto the edge: its weights were fitted
/// to those.
///
/// @param segmentation  used up: a scan's volumes are large
/// @param label_of  of the bones that have voxels in `labels`
/// @param ct  [HU], the whole scan
/// @param labels  of the part that was segmented; made to agree with the surfaces
[[nodiscard]] SurfacedBones surface_bones(imaging::BoneSegmentation segmentation,
                                          std::span<const std::uint8_t> label_of,
                                          const anatomy::BoneNaming& naming,
                                          const GridView<const std::int16_t>& ct,
                                          const BoneSurfaceOptions& options,
                                          const GridView<std::uint8_t>& labels);

}  // namespace carpus::reconstruct
