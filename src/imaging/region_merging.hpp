// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which regions of a segmentation touch, how, and joining those that are one body.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/grid.hpp"
#include "imaging/masked_values.hpp"
#include "imaging/watershed.hpp"

namespace carpus::imaging {

/// Where two regions touch.
struct Contact {
  double area_mm2 = 0;  ///< of the voxel faces between them
  float saddle = 0;     ///< greatest of min(height on both sides) over those faces
};

/// Regions 1..count, their sizes, peaks and contacts.
struct RegionTable {
  std::vector<std::size_t> voxels;  ///< [label]; [0] unused
  std::vector<float> peak;          ///< [label] greatest height inside
  std::map<std::pair<RegionLabel, RegionLabel>, Contact> contacts;  ///< first < second
};

/// Measures `labels`; `height` is e.g. the distance to the background [mm].
[[nodiscard]] RegionTable measure_regions(const GridView<const RegionLabel>& labels,
                                          const GridView<const float>& height);
/// The same with the heights of a mask that holds all regions.
[[nodiscard]] RegionTable measure_regions(const GridView<const RegionLabel>& labels,
                                          const MaskedValues& height);

struct MergeOptions {
  /// Touching regions are one body if the neck between them is at least this part of the smaller
  /// one's peak. Within one bone 0.9 and more was measured, between bones 0.3 and less.
  double neck_ratio = 0.6;
  double min_volume_mm3 = 0;  ///< smaller ones join the neighbour they touch most, or go
};

/// New label for each old one, numbered 1.. without holes in the order of the old; 0 = dropped.
/// The pair with the greatest neck ratio is joined first and its ratios are computed anew, until
/// none reaches the limit; then small regions are dealt with, smallest first.
[[nodiscard]] std::vector<RegionLabel> merge_regions(RegionTable table,
                                                     double voxel_volume_mm3,
                                                     const MergeOptions& options);

/// Replaces each label by labels_to[label].
void relabel(const GridView<RegionLabel>& labels, const std::vector<RegionLabel>& labels_to);

/// Keeps the largest connected component (6 neighbours) of each region; the rest becomes 0.
/// Returns the number of voxels removed.
std::size_t keep_largest_components(const GridView<RegionLabel>& labels);

/// The same, but a further component of at least `least_voxels` becomes a region of its own,
/// numbered from `count` + 1, and is counted: a fragment that hung on by a bridge is no noise.
std::size_t part_components(const GridView<RegionLabel>& labels,
                            std::size_t least_voxels,
                            RegionLabel& count);

}  // namespace carpus::imaging
