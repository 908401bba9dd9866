// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One volume file (NIfTI, NRRD, MetaImage) into a grid, its memory order as stored.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "case_io/detail/voxel_values.hpp"
#include "geometry/grid.hpp"

namespace carpus::case_io {

inline constexpr std::string_view kKnownFormats =
    "a DICOM series, NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd)";

/// Whether the name ends like a volume file that can be read.
[[nodiscard]] bool is_volume_file(const std::filesystem::path& file);

/// What the file's header says about it; empty where it says nothing or cannot be read.
[[nodiscard]] std::string description_of_volume_file(const std::filesystem::path& file);

/// What reading found besides the values.
struct ReadingNotes {
  ValueCount count;
  std::vector<std::string> conventions;  ///< what was taken by convention, in words for the report
};

/// Reads geometry and values; T is int16_t, uint8_t or float. The header is parsed here, the voxels
/// are unpacked and converted in a child process.
/// @throws IoError on missing, damaged, cut or overlong files; InvalidInput on other formats or
/// unusable geometry.
template <typename T>
[[nodiscard]] Grid<T> read_volume_file(const std::filesystem::path& file, ReadingNotes& notes);

}  // namespace carpus::case_io
