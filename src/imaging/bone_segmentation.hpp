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
#include "imaging/watershed.hpp"

namespace carpus::imaging {

/// Every number is a length in mm or a density in HU of human bone at CT, not of one scan.
struct BoneSegmentationOptions {
  double smoothing_sigma_mm = 0.3;  ///< against noise; about one voxel
  double cleft_sigma_mm = 0.5;      ///< half the width of a joint cleft
  double cleft_weight = 2.0;        ///< how much a cleft (dark_sheet_measure) lowers the density
  double bone_threshold_hu = 250;   ///< between soft tissue (45) and thin blurred cortex (650)
  double crop_threshold_hu = 400;   ///< only bone is denser; finds the part of the scan to look at
  double crop_margin_mm = 4.0;
  double peak_prominence_mm = 0.2;  ///< lesser dents in a bone are not two bones
  double peak_height_mm = 1.0;      ///< half the thickness of the thinnest bone
  double neck_ratio = 0.6;          ///< see MergeOptions
  double min_bone_mm3 = 100;        ///< a pisiform has 600; smaller pieces are spurs or noise
  double edge_sigma_mm = 0.3;       ///< gradient of the final watershed
  double marker_depth_mm = 0.6;     ///< markers of the final watershed reach into the cortex
  double rim_depth_mm = 0.9;        ///< how deep the half-maximum rule may cut
  double rim_reach_mm = 1.5;        ///< where the rule looks for the local maximum
  double rim_fraction = 0.5;        ///< edge of a blurred cortex: half-way to its maximum
};

enum class SegmentationStatus : std::uint8_t {
  Failed,
  Ok,
  NoBone,  ///< nothing is as dense as bone, or it encloses nothing
};

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

/// Segments the bones in `ct` [HU]. Progress names the stages. Deterministic.
[[nodiscard]] BoneSegmentation segment_bones(const GridView<const std::int16_t>& ct,
                                             const BoneSegmentationOptions& options,
                                             const Progress& progress);

}  // namespace carpus::imaging
