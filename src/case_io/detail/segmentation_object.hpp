// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes of a DICOM segmentation, laid onto a grid: what a disposable child does for
// read_dicom_segmentation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "geometry/grid.hpp"

namespace carpus::case_io {

constexpr std::size_t kMostSegments = 255;
constexpr std::size_t kLongestSegmentName = 64;

/// What the object says beside its voxels, of a fixed size: it is handed over in shared memory.
struct SegmentationObject {
  std::array<std::array<char, kLongestSegmentName>, kMostSegments> names{};  ///< of segment i + 1
  std::uint64_t segments = 0;                                                ///< the largest number
  std::uint64_t disputed = 0;  ///< voxels that a later segment claims too
};

/// By our own strict reader, before a library sees it: every element ends within its bounds, and
/// nothing follows the last.
/// @throws IoError, InvalidInput that name `file`.
void check_segmentation_structure(const std::string& bytes, const std::string& file);

/// @pre check_segmentation_structure has let the bytes pass.
/// @param labels  a value a voxel of `onto`, 0 before; afterwards segment numbers
/// @throws as read_dicom_segmentation.
void lay_segmentation_on(const std::string& bytes,
                         const std::string& file,
                         const GridGeometry& onto,
                         std::span<std::uint8_t> labels,
                         SegmentationObject& found);

}  // namespace carpus::case_io
