// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bones outlined by another program: a DICOM segmentation object [dicom_ps3_3 A.51], laid onto the
// grid of its scan. DCMTK parses it in a disposable child.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::case_io {

struct ReadSegmentation {
  Grid<std::uint8_t> labels;       ///< segment numbers; of two that claim a voxel, the first
  std::vector<std::string> names;  ///< Segment Label of segment i + 1; may be empty
  std::uint64_t disputed = 0;      ///< voxels that a later segment claims too
};

/// @param onto  the scan's grid, as read_ct gives it; slices and pixels must lie on it, whichever
///     way round.
/// @throws IoError where the file is none, damaged or takes too much; InvalidInput where it is
/// fractional, has more than 255 segments, or does not lie on the grid.
[[nodiscard]] ReadSegmentation read_dicom_segmentation(const std::filesystem::path& file,
                                                       const GridGeometry& onto);

}  // namespace carpus::case_io
