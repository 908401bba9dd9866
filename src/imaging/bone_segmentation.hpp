// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a CT of a wrist to one region per bone, without clicks and without a shape prior: the bones
// are found by their cortex and their joint clefts, and delimited by a watershed of the gradient.
// Names come later (anatomy/bone_naming.hpp).
#pragma once

#include <cstdint>

#include "core/progress.hpp"
#include "geometry/grid.hpp"
#include "imaging/bone_markers.hpp"
#include "imaging/watershed.hpp"

namespace carpus::imaging {

struct BoneSegmentation {
  SegmentationStatus status = SegmentationStatus::Failed;
  RegionLabel region_count = 0;
  Grid<RegionLabel> regions;  ///< on the part of the scan that holds bone: 0 or 1..region_count
  Grid<float> smoothed_hu;    ///< the CT smoothed with smoothing_sigma_mm, same part
  Grid<float> edge_excess;    ///< (HU - half-maximum) / (maximum - soft tissue) where it is known,
                              ///< which is near bone surfaces; 0 on a bone's edge, < 0 outside it
  VoxelIndex offset;          ///< voxel of the scan at which the part begins
  double soft_tissue_hu = 0;  ///< median density around the bones
  double densest_hu = 0;      ///< of the smoothed scan
};

/// Segments the bones in what smooth_scan (bone_markers.hpp) made of a scan.
[[nodiscard]] BoneSegmentation segment_bones(SmoothedScan scan,
                                             const BoneSegmentationOptions& options,
                                             const Progress& progress);

/// Segments the bones in `ct` [HU]. Progress names the stages. Deterministic.
[[nodiscard]] BoneSegmentation segment_bones(const GridView<const std::int16_t>& ct,
                                             const BoneSegmentationOptions& options,
                                             const Progress& progress);

}  // namespace carpus::imaging
