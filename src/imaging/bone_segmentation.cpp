// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Markers (bone_markers.hpp). 2. Watershed of the gradient from them. 3. Trim the rim to the
// half-maximum of the local cortex.
#include "imaging/bone_segmentation.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "imaging/edge_excess.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/region_merging.hpp"

namespace carpus::imaging {
BoneSegmentation segment_bones(const GridView<const std::int16_t>& ct,
                               const BoneSegmentationOptions& options,
                               const Progress& progress) {
  progress("smooth", 0.0);
  return segment_bones(smooth_scan(ct, options), options, progress);
}

BoneSegmentation segment_bones(SmoothedScan scan,
                               const BoneSegmentationOptions& options,
                               const Progress& progress) {
  constexpr double kMarkersShare = 0.7;
  const std::optional<BlockView<std::int16_t>> hu = scan.hu;
  BoneMarkers found = find_bone_markers(
      std::move(scan), options,
      [&](std::string_view stage, double fraction) { progress(stage, kMarkersShare * fraction); });
  BoneSegmentation result;
  result.status = found.status;
  result.densest_hu = found.densest_hu;
  result.offset = found.offset;
  result.soft_tissue_hu = found.soft_tissue_hu;
  result.smoothed_hu = std::move(found.smoothed_hu);
  if (found.status != SegmentationStatus::Ok) return result;
  result.region_count = found.bone_count;
  result.regions = std::move(found.markers);

  progress("gradient", kMarkersShare);
  Grid<float> gradient = gradient_magnitude(*hu, options.edge_sigma_mm);
  progress("watershed", 0.8);
  flood_from_markers(std::move(gradient), {}, result.regions.view());
  for (RegionLabel& label : result.regions.values()) {
    if (label == found.outside()) label = 0;
  }
  progress("rim", 0.9);
  result.edge_excess = measure_edge_excess(result.smoothed_hu.view(), found.mask.view(),
                                           static_cast<float>(found.soft_tissue_hu), options);
  for (std::size_t i = 0; i < result.regions.values().size(); ++i) {
    if (found.mask[i] != BoneMarkers::kDeep && result.edge_excess[i] < 0) {
      result.regions[i] = 0;
    }
  }
  found.mask = {};
  part_components(
      result.regions.view(),
      static_cast<std::size_t>(options.min_bone_mm3 / result.regions.geometry().voxel_volume_mm3()),
      result.region_count);
  return result;
}

}  // namespace carpus::imaging
