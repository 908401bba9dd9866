// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a person painted on a case's labels, and nothing else of the case, made anew: the surfaces
// of the bones that were touched and, if wanted, the water let in again from what was painted.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/mesh_in.hpp"
#include "imaging/bone_markers.hpp"
#include "reconstruct/bone_surface.hpp"

namespace carpus::reconstruct {

struct MendOptions {
  /// What was painted is a marker, and the watershed finds how far its bone goes; else it is
  /// the bone as it is to be.
  bool grows = false;
  imaging::BoneSegmentationOptions segmentation;
  BoneSurfaceOptions surface;
};

struct MendedBone {
  std::uint8_t label = 0;
  double volume_mm3 = 0;        ///< of its voxels; 0 where it has none any more
  MeshIn<frame::Bone> surface;  ///< [Patient, mm]; empty where it has no voxels
};

struct Mended {
  Grid<std::uint8_t> labels;      ///< of the whole scan; another bone's voxels are never changed
  std::vector<MendedBone> bones;  ///< that were touched, by their labels
};

/// @param ct  [HU]
/// @param before  labels (anatomy/bone_id.hpp) before the last strokes
/// @param painted  and after them, on the same grid: where the two differ is what was painted
/// @throws InvalidInput where grids differ, or nothing was painted.
///
/// Growing, in the box of the bones that were touched:
/// 1. A bone that lost voxels to another one keeps as its marker its deepest part that holds no
///    foreign paint; one that lost none keeps all of itself. Untouched bones are markers whole.
/// 2. Depth within bones, and within dense tissue that hangs together with the paint, is flooded
/// from
///    the markers: bones part at their narrowest.
/// 3. The inner parts are the markers of the gradient's watershed, its rim is trimmed to the
///    half-maximum of the cortex, as in imaging/bone_segmentation.hpp.
[[nodiscard]] Mended mend_bones(const GridView<const std::int16_t>& ct,
                                const Grid<std::uint8_t>& before,
                                const Grid<std::uint8_t>& painted,
                                const MendOptions& options = {});

}  // namespace carpus::reconstruct
