// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Smooth; crop to what is dense. 2. Bone mask: flood the outside through everything that is not
// dense or lies in a dark cleft; what the flood cannot reach is bone and the marrow it encloses.
// 3. Distance to the mask's border; its prominent peaks are markers; watershed. 4. Join regions
// whose neck is nearly as thick as they are. 5. Watershed of the gradient between the regions'
// inner parts and the outside. 6. Trim the rim to the half-maximum of the local cortex.
#include "imaging/bone_segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/box_maximum.hpp"
#include "imaging/distance_transform.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/peak_markers.hpp"
#include "imaging/region_merging.hpp"

namespace carpus::imaging {
namespace {

/// Muscle, tendon, cartilage and fluid lie in this range; fat and air below, bone above.
constexpr float kSoftTissueLowHu = -50;
constexpr float kSoftTissueHighHu = 150;
/// Where no such tissue is seen (a bone in air), muscle's usual density.
constexpr float kUsualSoftTissueHu = 45;
/// Distances are compared as heights of less than this many levels [mm] when flooding.
constexpr std::size_t kGrain = 1U << 16U;

Grid<std::uint8_t> enclosed_by_bone(const Grid<float>& smoothed,
                                    const Grid<float>& cleft,
                                    const BoneSegmentationOptions& options) {
  Grid<std::uint8_t> low(smoothed.geometry());
  const auto weight = static_cast<float>(options.cleft_weight);
  const auto threshold = static_cast<float>(options.bone_threshold_hu);
  for (std::size_t i = 0; i < low.values().size(); ++i) {
    low[i] = smoothed[i] - weight * cleft[i] < threshold ? 1 : 0;
  }
  const Components components = connected_components(low.view());
  const std::uint32_t outside = components.largest();
  Grid<std::uint8_t> mask(smoothed.geometry());
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    mask[i] = outside == 0 || components.labels[i] != outside ? 1 : 0;
  }
  return opened_by_one_voxel(mask.view());
}

float median_soft_tissue(const Grid<float>& smoothed, const Grid<std::uint8_t>& mask) {
  std::vector<float> values;
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const float v = smoothed[i];
    if (mask[i] == 0 && v >= kSoftTissueLowHu && v <= kSoftTissueHighHu) values.push_back(v);
  }
  if (values.empty()) return kUsualSoftTissueHu;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Steps 3 and 4: the bodies within the mask, one label each. Returns how many.
RegionLabel separate_bodies(const Grid<std::uint8_t>& mask,
                            const Grid<float>& depth,
                            const BoneSegmentationOptions& options,
                            Grid<RegionLabel>& regions) {
  const auto peaks = prominent_peaks(depth.view(), mask.view(),
                                     {options.peak_prominence_mm, options.peak_height_mm});
  const std::size_t most = 60000;  // fits a RegionLabel; noise alone makes so many
  for (std::size_t i = 0; i < std::min(peaks.size(), most); ++i) {
    regions[peaks[i]] = static_cast<RegionLabel>(i + 1);
  }
  Grid<float> relief(depth.geometry());
  for (std::size_t i = 0; i < relief.values().size(); ++i) relief[i] = -depth[i];
  flood_from_markers(relief.view(), mask.values(), {}, regions.view());
  const auto merged = merge_regions(measure_regions(regions.view(), depth.view()),
                                    depth.geometry().voxel_volume_mm3(),
                                    {options.neck_ratio, options.min_bone_mm3});
  relabel(regions.view(), merged);
  return merged.empty() ? RegionLabel{0} : *std::max_element(merged.begin(), merged.end());
}

/// Step 5: from the inner parts of the regions and the outside to the crest of the gradient.
void flood_to_edges(const Grid<float>& gradient,
                    const Grid<std::uint8_t>& mask,
                    const Grid<float>& depth,
                    RegionLabel count,
                    const BoneSegmentationOptions& options,
                    Grid<RegionLabel>& regions) {
  const auto background = static_cast<RegionLabel>(count + 1);
  for (std::size_t i = 0; i < regions.values().size(); ++i) {
    if (mask[i] == 0) {
      regions[i] = background;
    } else if (!(static_cast<double>(depth[i]) > options.marker_depth_mm)) {
      regions[i] = 0;
    }
  }
  flood_from_markers(gradient.view(), {}, {}, regions.view());
  for (RegionLabel& label : regions.values()) label = label == background ? RegionLabel{0} : label;
}

/// How far each voxel is above the half-maximum of the cortex near it, as a part of that cortex.
Grid<float> measure_edge_excess(const Grid<float>& smoothed,
                                const Grid<std::uint8_t>& mask,
                                float soft_tissue,
                                const BoneSegmentationOptions& options) {
  Grid<float> inside(smoothed.geometry());
  for (std::size_t i = 0; i < inside.values().size(); ++i) {
    inside[i] = mask[i] != 0 ? smoothed[i] : soft_tissue;
  }
  Grid<float> excess = box_maximum(inside.view(), options.rim_reach_mm);
  const auto fraction = static_cast<float>(options.rim_fraction);
  parallel_for(excess.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float range = excess[i] - soft_tissue;
      excess[i] = range > 0 ? (smoothed[i] - soft_tissue) / range - fraction : -fraction;
    }
  });
  return excess;
}

}  // namespace

BoneSegmentation segment_bones(const GridView<const std::int16_t>& ct,
                               const BoneSegmentationOptions& options,
                               const Progress& progress) {
  BoneSegmentation result;
  progress("smooth", 0.0);
  const Grid<float> whole = as_float(ct);
  const Grid<float> smoothed_whole = gaussian_smooth(whole.view(), options.smoothing_sigma_mm);
  if (whole.values().empty()) return result;
  result.densest_hu = static_cast<double>(
      *std::max_element(smoothed_whole.values().begin(), smoothed_whole.values().end()));
  const auto box =
      box_above(smoothed_whole.view(), options.crop_threshold_hu, options.crop_margin_mm);
  if (!box) {
    result.status = SegmentationStatus::NoBone;
    return result;
  }
  result.offset = box->low;
  const Grid<float> image = crop(whole.view(), *box);
  result.smoothed_hu = crop(smoothed_whole.view(), *box);

  progress("joint clefts", 0.15);
  const Grid<float> cleft = dark_sheet_measure(image.view(), options.cleft_sigma_mm);
  progress("bone mask", 0.4);
  const Grid<std::uint8_t> mask = enclosed_by_bone(result.smoothed_hu, cleft, options);
  const float soft_tissue = median_soft_tissue(result.smoothed_hu, mask);
  result.soft_tissue_hu = static_cast<double>(soft_tissue);
  const Grid<float> depth = distance_to_background(mask.view());

  progress("markers", 0.5);
  result.regions = Grid<RegionLabel>(image.geometry());
  result.region_count = separate_bodies(mask, depth, options, result.regions);
  if (result.region_count == 0) {
    result.status = SegmentationStatus::NoBone;
    return result;
  }
  progress("gradient", 0.7);
  const Grid<float> gradient = gradient_magnitude(image.view(), options.edge_sigma_mm);
  progress("watershed", 0.8);
  flood_to_edges(gradient, mask, depth, result.region_count, options, result.regions);
  progress("rim", 0.9);
  result.edge_excess = measure_edge_excess(result.smoothed_hu, mask, soft_tissue, options);
  for (std::size_t i = 0; i < result.regions.values().size(); ++i) {
    if (static_cast<double>(depth[i]) <= options.rim_depth_mm && result.edge_excess[i] < 0) {
      result.regions[i] = 0;
    }
  }
  keep_largest_components(result.regions.view());
  result.status = SegmentationStatus::Ok;
  return result;
}

}  // namespace carpus::imaging
