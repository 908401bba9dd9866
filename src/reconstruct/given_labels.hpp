// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bones that a person or another program has outlined and named: a case is made of them as of those
// that were found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "reconstruct/named_segmentation.hpp"

namespace carpus::reconstruct {

/// A segmentation as segment_and_name returns it, of labels that are given.
struct GivenSegmentation {
  NamedSegmentation named;
  std::vector<std::string> warnings;  ///< names that the fit would not give
};

/// The names stay as they are given; side, wrist frame and misfits come from the fit.
///
/// @param labels  by the numbers of anatomy/bone_id.hpp, on the CT's own grid
/// @throws InvalidInput where there is no bone, a number is none of a bone, or grids differ.
[[nodiscard]] GivenSegmentation describe_labels(const Grid<std::int16_t>& ct,
                                                const Grid<std::uint8_t>& labels,
                                                const imaging::BoneSegmentationOptions& options);

}  // namespace carpus::reconstruct
