// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Label files from elsewhere in this program's numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "geometry/grid.hpp"

namespace carpus::reconstruct {

/// Reads a label volume or a DICOM segmentation for the scan on the grid `ct`.
///
/// @param names  {"radius": 1, ...}: which number, or segment, is which bone. Empty: a volume has
///     the numbers of anatomy/bone_id.hpp, a segmentation's segments are called as bones are.
/// @param warn  receives what was left out, in words
/// @throws IoError, InvalidInput naming the file: also a name that is no bone's, a number given
/// twice, or no bone left.
[[nodiscard]] Grid<std::uint8_t> read_given_labels(
    const std::filesystem::path& file,
    const std::filesystem::path& names,
    const GridGeometry& ct,
    const std::function<void(const std::string&)>& warn);

}  // namespace carpus::reconstruct
