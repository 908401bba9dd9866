// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Smooth; crop to what is dense. 2. Bone mask: flood the outside through everything that is not
// dense or lies in a dark cleft; what the flood cannot reach is bone and the marrow it encloses.
// 3. Distance to the mask's border; its prominent peaks are markers; watershed. 4. Join regions
// whose neck is nearly as thick as they are. 5. What lies deep in a region is the bone's marker.
#include "imaging/bone_markers.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "imaging/between_bones.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/detail/run_components.hpp"
#include "imaging/distance_transform.hpp"
#include "imaging/edge_excess.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/masked_values.hpp"
#include "imaging/peak_markers.hpp"
#include "imaging/region_merging.hpp"

namespace carpus::imaging {
namespace {

/// Voxels that one task of a loop takes at least.
constexpr std::size_t kGrain = 1U << 16U;

/// The largest dark body, and any other so large that it is no marrow: within a splint the flesh
/// has no way to the air.
std::vector<char> outside_components(const std::vector<std::size_t>& voxels,
                                     const GridGeometry& g) {
  constexpr double kMostMarrowMm3 = 30000;
  std::vector<char> is_outside(voxels.size(), 0);
  const auto largest =
      static_cast<std::size_t>(std::max_element(voxels.begin(), voxels.end()) - voxels.begin());
  for (std::size_t c = 1; c < voxels.size(); ++c) {
    const double mm3 = static_cast<double>(voxels[c]) * g.voxel_volume_mm3();
    is_outside[c] = c == largest || mm3 > kMostMarrowMm3 ? 1 : 0;
  }
  return is_outside;
}

/// What is not dense, or lies in a dark cleft between two bones.
Grid<std::uint8_t> open_to_water(const Grid<float>& smoothed,
                                 const Grid<float>& cleft,
                                 const BoneSegmentationOptions& options) {
  Grid<std::uint8_t> low(smoothed.geometry());
  const auto weight = static_cast<float>(options.cleft_weight);
  const auto threshold = static_cast<float>(options.bone_threshold_hu);
  const auto floor = static_cast<float>(options.cleft_floor_hu);
  const auto rise = static_cast<float>(options.cleft_rise_hu);
  parallel_for(low.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_dark = smoothed[i] < threshold;
      const bool may_be_cleft =
          !is_dark && smoothed[i] - weight * std::max(0.0F, cleft[i] - floor) < threshold;
      const bool is_low =
          is_dark ||
          (may_be_cleft && lies_between_bones(smoothed.view(), low.geometry().index_of(i),
                                              options.cleft_reach_mm, rise));
      low[i] = is_low ? 1 : 0;
    }
  });
  return low;
}

/// What no water from outside reaches; in the place of `low`.
Grid<std::uint8_t> enclosed_by_bone(Grid<std::uint8_t> low) {
  {
    const detail::RunComponents bodies{GridView<const std::uint8_t>(low.view())};
    const std::vector<char> is_outside = outside_components(bodies.voxels(), low.geometry());
    std::fill(low.values().begin(), low.values().end(), std::uint8_t{1});
    bodies.for_each([&](std::size_t first, std::size_t end, std::uint32_t body) {
      if (is_outside[body] == 0) return;
      std::fill(low.values().begin() + static_cast<std::ptrdiff_t>(first),
                low.values().begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{0});
    });
  }
  return opened_by_one_voxel(low.view());
}

/// Distance into the mask [mm].
MaskedValues depth_within(const Grid<std::uint8_t>& mask) {
  const Grid<float> depth = distance_to_background(mask.view());
  return {depth.view(), mask.view()};
}

/// Steps 3 and 4: the bodies within the mask, one label each. Returns how many.
RegionLabel separate_bodies(const MaskedValues& depth,
                            const BoneSegmentationOptions& options,
                            Grid<RegionLabel>& regions) {
  const auto peaks = prominent_peaks(depth, {options.peak_prominence_mm, options.peak_height_mm});
  regions = Grid<RegionLabel>(depth.geometry());
  const std::size_t most = 60000;  // fits a RegionLabel; noise alone makes so many
  for (std::size_t i = 0; i < std::min(peaks.size(), most); ++i) {
    regions[peaks[i]] = static_cast<RegionLabel>(i + 1);
  }
  flood_depths_from_markers(depth, {}, regions.view());
  const auto merged =
      merge_regions(measure_regions(regions.view(), depth), depth.geometry().voxel_volume_mm3(),
                    {options.neck_ratio, options.min_bone_mm3});
  relabel(regions.view(), merged);
  return merged.empty() ? RegionLabel{0} : *std::max_element(merged.begin(), merged.end());
}

/// Step 5: bodies keep what is deeper than marker_depth_mm; the outside is a body too.
void keep_inner_parts(const BoneSegmentationOptions& options,
                      const MaskedValues& depth,
                      BoneMarkers& found) {
  for (std::size_t i = 0; i < found.markers.values().size(); ++i) {
    if (found.mask[i] == 0) found.markers[i] = found.outside();
  }
  depth.for_each([&](std::size_t i, float depth_mm) {
    if (!(static_cast<double>(depth_mm) > options.marker_depth_mm)) found.markers[i] = 0;
  });
}

/// All that is still wanted of the depth goes into the mask.
void mark_rim(double rim_depth_mm, const MaskedValues& depth, Grid<std::uint8_t>& mask) {
  depth.for_each([&](std::size_t i, float depth_mm) {
    mask[i] =
        static_cast<double>(depth_mm) <= rim_depth_mm ? BoneMarkers::kRim : BoneMarkers::kDeep;
  });
}

}  // namespace

SmoothedScan smooth_scan(const GridView<const std::int16_t>& ct,
                         const BoneSegmentationOptions& options) {
  SmoothedScan scan;
  const Grid<float> smoothed = gaussian_smooth(ct, options.smoothing_sigma_mm);
  if (smoothed.values().empty()) return scan;
  scan.densest_hu =
      static_cast<double>(*std::max_element(smoothed.values().begin(), smoothed.values().end()));
  const auto box = box_above(smoothed.view(), options.crop_threshold_hu, options.crop_margin_mm);
  if (!box) return scan;
  scan.holds_bone = true;
  scan.offset = box->low;
  scan.hu.emplace(ct, *box);
  scan.smoothed_hu = crop(smoothed.view(), *box);
  return scan;
}

BoneMarkers find_bone_markers(const GridView<const std::int16_t>& ct,
                              const BoneSegmentationOptions& options,
                              const Progress& progress) {
  progress("smooth", 0.0);
  return find_bone_markers(smooth_scan(ct, options), options, progress);
}

BoneMarkers find_bone_markers(SmoothedScan scan,
                              const BoneSegmentationOptions& options,
                              const Progress& progress) {
  BoneMarkers found;
  found.densest_hu = scan.densest_hu;
  found.status = SegmentationStatus::NoBone;
  if (!scan.holds_bone) return found;
  found.offset = scan.offset;
  found.smoothed_hu = std::move(scan.smoothed_hu);

  progress("joint clefts", 0.2);
  Grid<float> cleft = dark_sheet_measure(*scan.hu, options.cleft_sigma_mm);
  progress("bone mask", 0.57);
  Grid<std::uint8_t> low = open_to_water(found.smoothed_hu, cleft, options);
  cleft = {};
  found.mask = enclosed_by_bone(std::move(low));
  found.soft_tissue_hu =
      static_cast<double>(median_soft_tissue(found.smoothed_hu.view(), found.mask.view()));
  const MaskedValues depth = depth_within(found.mask);

  progress("markers", 0.71);
  found.bone_count = separate_bodies(depth, options, found.markers);
  if (found.bone_count == 0) return found;
  keep_inner_parts(options, depth, found);
  mark_rim(options.rim_depth_mm, depth, found.mask);
  found.status = SegmentationStatus::Ok;
  return found;
}

}  // namespace carpus::imaging
