// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Markers (bone_markers.hpp). 2. Watershed of the gradient from them. 3. Trim the rim to the
// half-maximum of the local cortex.
#include "imaging/bone_segmentation.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "imaging/edge_excess.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/region_merging.hpp"

namespace carpus::imaging {
namespace {

/// What a voxel of the mask may be besides 0, which is outside.
constexpr std::uint8_t kDeep = 1;
constexpr std::uint8_t kRim = 2;

/// All that is still wanted of the depth goes into the mask: volumes are large.
void mark_rim(double rim_depth_mm, BoneMarkers& found) {
  for (std::size_t i = 0; i < found.mask.values().size(); ++i) {
    if (found.mask[i] == 0) continue;
    found.mask[i] = static_cast<double>(found.depth[i]) <= rim_depth_mm ? kRim : kDeep;
  }
  found.depth = {};
}

}  // namespace

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
  mark_rim(options.rim_depth_mm, found);
  {
    const Grid<float> gradient = gradient_magnitude(found.hu.view(), options.edge_sigma_mm);
    found.hu = {};
    progress("watershed", 0.8);
    flood_from_markers(gradient.view(), {}, {}, result.regions.view());
  }
  for (RegionLabel& label : result.regions.values()) {
    if (label == found.outside()) label = 0;
  }
  progress("rim", 0.9);
  result.edge_excess = measure_edge_excess(result.smoothed_hu.view(), found.mask.view(),
                                           static_cast<float>(found.soft_tissue_hu), options);
  for (std::size_t i = 0; i < result.regions.values().size(); ++i) {
    if (found.mask[i] != kDeep && result.edge_excess[i] < 0) {
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
