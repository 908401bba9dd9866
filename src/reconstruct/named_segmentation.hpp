// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a CT to named bones as labels: what a case begins with, and all that studies of the
// segmentation ask for.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "anatomy/bone_naming.hpp"
#include "geometry/grid.hpp"
#include "imaging/bone_segmentation.hpp"

namespace carpus::reconstruct {

struct NamedSegmentation {
  imaging::BoneSegmentation segmentation;
  anatomy::BoneNaming naming;
};

/// Called with the stage's name and the part of this work that is done (0 to 1).
using SegmentStage = std::function<void(std::string_view name, double fraction)>;

/// Segments and names; where the names do not fit, tries other weights for the clefts and keeps the
/// best naming.
/// @throws InvalidInput where there is no bone, saying what was seen.
[[nodiscard]] NamedSegmentation segment_and_name(const Grid<std::int16_t>& ct,
                                                 imaging::BoneSegmentationOptions options,
                                                 const SegmentStage& stage);

/// The label that a region's name has in a case.
[[nodiscard]] std::uint8_t label_for(const anatomy::RegionName& name);

/// Bone labels instead of region numbers, on the part of the scan that was segmented.
[[nodiscard]] Grid<std::uint8_t> bone_labels(const NamedSegmentation& named);

/// Labels of a part of a scan on all of it.
[[nodiscard]] Grid<std::uint8_t> on_whole_scan(const Grid<std::uint8_t>& part,
                                               const VoxelIndex& offset,
                                               const GridGeometry& whole);

}  // namespace carpus::reconstruct
