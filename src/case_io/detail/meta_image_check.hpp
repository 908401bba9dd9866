// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a MetaImage is all there: its library prints a complaint about missing voxels and goes
// on.
#pragma once

#include <cstdint>
#include <filesystem>

namespace carpus::case_io {

/// Compares the length of the voxel data, in the file itself or beside it, with what is needed.
/// @param bytes  of all voxels, uncompressed.
/// @throws IoError where the data is not there or cut short.
void check_meta_image_is_whole(const std::filesystem::path& file, std::uintmax_t bytes);

}  // namespace carpus::case_io
