// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of a watershed by markers as pictures, as figures 3.1 to 3.4 of the thesis show them
// [yaacoub2008].
#pragma once

#include <cstdint>
#include <filesystem>

#include "geometry/grid.hpp"
#include "imaging/watershed.hpp"

namespace carpus::figures {

/// What a watershed began with and came to; all on one grid.
struct SegmentSteps {
  GridView<const std::int16_t> ct;               ///< HU
  GridView<const float> gradient;                ///< HU per mm
  GridView<const imaging::RegionLabel> markers;  ///< 0 = none
  GridView<const imaging::RegionLabel> labels;   ///< 0 = no bone
  imaging::RegionLabel outside = 0;              ///< the markers' label of no bone; 0 = none
};

/// The axial slice that shows the most labels, and of those the one with the most labelled voxels.
[[nodiscard]] int most_telling_slice(const GridView<const imaging::RegionLabel>& labels);

/// Writes 1_ct.png, 2_gradient_and_markers.png, 3_watershed.png (slice `z`; voxels square in mm,
/// the patient's front above and left side to the right, as radiologists look) and 4_bones.svg
/// (every label's surface, seen from the patient's front) into `folder`, which is made where
/// missing.
/// @throws IoError where one cannot be written.
void write_segment_pictures(const std::filesystem::path& folder, const SegmentSteps& steps, int z);

}  // namespace carpus::figures
