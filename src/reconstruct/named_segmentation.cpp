// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/named_segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "imaging/block_view.hpp"
#include "imaging/gaussian.hpp"

namespace carpus::reconstruct {
namespace {

using anatomy::BoneNaming;
using imaging::BoneSegmentation;

std::string hu(double value) { return std::to_string(std::lround(value)) + " HU"; }

[[noreturn]] void refuse_boneless(const BoneSegmentation& s, const GridGeometry& g) {
  throw InvalidInput(
      "no bone found in the volume of " + std::to_string(g.size[0]) + " x " +
      std::to_string(g.size[1]) + " x " + std::to_string(g.size[2]) +
      " voxels: the densest smoothed value is " + hu(s.densest_hu) +
      ", cortical bone has more than 650 HU and encloses its marrow. Give a CT of a wrist in "
      "Hounsfield units (not MRI, not a label volume), with the rescale slope and intercept "
      "intact.");
}

/// How bones are told from clefts: a strong weight parts narrow joints, but pierces the thin cortex
/// of scans with thick slices or much noise, so that bones fall apart or fill up with outside.
struct Separation {
  double cleft_weight;
  double bone_threshold_hu;
};

/// Tried in this order, after the options as given, until the names fit; the best fit is kept. With
/// 1 mm slices the second was right where the first was not (misfit 0.7 against 36), with 1.25 mm
/// the third (0.7 against 237).
constexpr std::array<Separation, 3> kFurtherSeparations{{{1.0, 250}, {1.0, 180}, {3.0, 250}}};

/// What the first attempt was made of: it is smoothed once for all of them.
imaging::SmoothedScan smoothed_again(const Grid<std::int16_t>& ct, const BoneSegmentation& first) {
  const auto& size = first.smoothed_hu.geometry().size;
  const VoxelIndex& low = first.offset;
  const imaging::VoxelBox box{low, {low.x + size[0] - 1, low.y + size[1] - 1, low.z + size[2] - 1}};
  return {true, imaging::BlockView<std::int16_t>(ct.view(), box), first.smoothed_hu, low,
          first.densest_hu};
}

bool fits(const BoneNaming& naming) {
  return naming.cost < anatomy::kDoubtfulNamingCost && naming.missing.empty();
}

}  // namespace

NamedSegmentation segment_and_name(const Grid<std::int16_t>& ct,
                                   imaging::BoneSegmentationOptions options,
                                   const SegmentStage& stage) {
  const auto attempt = [&](imaging::SmoothedScan scan) {
    NamedSegmentation result;
    result.segmentation = imaging::segment_bones(
        std::move(scan), options,
        [&](std::string_view name, double fraction) { stage(name, fraction); });
    if (result.segmentation.status != imaging::SegmentationStatus::Ok) {
      refuse_boneless(result.segmentation, ct.geometry());
    }
    stage("names", 1.0);
    result.naming =
        anatomy::name_bones(result.segmentation.regions.view(), result.segmentation.region_count);
    return result;
  };
  stage("smooth", 0.0);
  NamedSegmentation best = attempt(imaging::smooth_scan(ct.view(), options));
  for (const Separation& other : kFurtherSeparations) {
    if (fits(best.naming)) break;
    options.cleft_weight = other.cleft_weight;
    options.bone_threshold_hu = other.bone_threshold_hu;
    NamedSegmentation next = attempt(smoothed_again(ct, best.segmentation));
    if (next.naming.cost < best.naming.cost) best = std::move(next);
  }
  return best;
}

std::uint8_t label_for(const anatomy::RegionName& name) {
  return name.part == BonePart::Distal ? kScaphoidDistalLabel
                                       : static_cast<std::uint8_t>(name.bone);
}

/// Replaces region numbers by bone labels, on the part of the scan that was segmented.
Grid<std::uint8_t> bone_labels(const NamedSegmentation& named) {
  const BoneNaming& naming = named.naming;
  std::vector<std::uint8_t> label_of_region(naming.regions.size() + 1, kBackgroundLabel);
  for (std::size_t i = 0; i < naming.regions.size(); ++i) {
    if (naming.regions[i]) label_of_region[i + 1] = label_for(*naming.regions[i]);
  }
  const Grid<imaging::RegionLabel>& regions = named.segmentation.regions;
  Grid<std::uint8_t> labels(regions.geometry());
  for (std::size_t i = 0; i < labels.values().size(); ++i) labels[i] = label_of_region[regions[i]];
  return labels;
}

Grid<std::uint8_t> on_whole_scan(const Grid<std::uint8_t>& part,
                                 const VoxelIndex& offset,
                                 const GridGeometry& whole) {
  Grid<std::uint8_t> labels(whole);
  const auto& [nx, ny, nz] = part.geometry().size;
  const std::uint8_t* row = part.values().data();
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y, row += nx) {
      const VoxelIndex first{offset.x, offset.y + y, offset.z + z};
      std::copy_n(row, nx, labels.values().data() + whole.offset_of(first));
    }
  }
  return labels;
}

}  // namespace carpus::reconstruct
