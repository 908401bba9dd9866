// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Markers for the watershed of a CT's bones without clicks: one inside each bone, found by cortex
// and joint clefts, and one for what lies between them.
#pragma once

#include <cstdint>
#include <optional>

#include "core/progress.hpp"
#include "geometry/grid.hpp"
#include "imaging/block_view.hpp"
#include "imaging/watershed.hpp"

namespace carpus::imaging {

/// Every number is a length in mm or a density in HU of human bone at CT, not of one scan.
struct BoneSegmentationOptions {
  double smoothing_sigma_mm = 0.3;  ///< against noise; about one voxel
  double cleft_sigma_mm = 0.5;      ///< half the width of a joint cleft
  double cleft_weight = 2.0;        ///< how much a cleft (dark_sheet_measure) lowers the density
  double cleft_floor_hu = 40;       ///< what trabeculae and noise measure; no cleft up to there
  double cleft_rise_hu = 150;       ///< how much denser bone is on both sides of a cleft
  double cleft_reach_mm = 1.6;      ///< within this distance
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
  double thin_rim_fraction = 0.57;  ///< at most, where the cortex is too thin to reach its own
};

enum class SegmentationStatus : std::uint8_t {
  Failed,
  Ok,
  NoBone,  ///< nothing is as dense as bone, or it encloses nothing
};

/// The part of a scan that is dense, and the same smoothed: serves every attempt at its bones.
struct SmoothedScan {
  bool holds_bone = false;  ///< something is as dense; else the rest but densest_hu is empty
  std::optional<BlockView<std::int16_t>> hu;  ///< the CT, which must outlive this
  Grid<float> smoothed_hu;                    ///< with smoothing_sigma_mm
  VoxelIndex offset;                          ///< voxel of the scan at which the part begins
  double densest_hu = 0;                      ///< of the smoothed scan
};

[[nodiscard]] SmoothedScan smooth_scan(const GridView<const std::int16_t>& ct,
                                       const BoneSegmentationOptions& options);

/// What is known of a scan's bones before their edges are.
struct BoneMarkers {
  static constexpr std::uint8_t kDeep = 1;
  static constexpr std::uint8_t kRim = 2;

  SegmentationStatus status = SegmentationStatus::Failed;
  RegionLabel bone_count = 0;
  /// On the part of the scan that holds bone: 1..bone_count inside each bone, outside() between
  /// and around them, 0 where the water has to decide.
  Grid<RegionLabel> markers;
  Grid<float> smoothed_hu;  ///< smoothed with smoothing_sigma_mm
  /// In bone and the marrow that it encloses kRim, up to rim_depth_mm deep, or kDeep; else 0.
  Grid<std::uint8_t> mask;
  VoxelIndex offset;          ///< voxel of the scan at which the part begins
  double soft_tissue_hu = 0;  ///< median density around the bones
  double densest_hu = 0;      ///< of the smoothed scan

  [[nodiscard]] RegionLabel outside() const { return static_cast<RegionLabel>(bone_count + 1); }
};

/// Finds the bones in what smooth_scan made of a scan. Progress names the stages, its fractions run
/// from 0 to 1.
[[nodiscard]] BoneMarkers find_bone_markers(SmoothedScan scan,
                                            const BoneSegmentationOptions& options,
                                            const Progress& progress);

/// Finds the bones in `ct` [HU]. Progress names the stages, its fractions run from 0 to 1.
[[nodiscard]] BoneMarkers find_bone_markers(const GridView<const std::int16_t>& ct,
                                            const BoneSegmentationOptions& options,
                                            const Progress& progress);

}  // namespace carpus::imaging
