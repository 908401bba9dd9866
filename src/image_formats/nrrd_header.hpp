// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// NRRD (.nrrd) and its header with the voxels in a file beside it (.nhdr).
#pragma once

#include <string_view>

#include "image_formats/volume_header.hpp"

namespace carpus::image_formats {

/// Reads the front of a file: three spatial axes, one number a voxel, raw or gzip. The space must
/// be said, because without it left and right are not known. Fields that the format does not know,
/// or that are there twice, are refused, as its definition demands.
/// @param front  the file's first kLongestHeaderText bytes, or all of it.
/// @throws IoError, InvalidInput  as Refuser says. Source: [nrrd_format].
[[nodiscard]] VolumeHeader parse_nrrd(std::string_view front, const Refuser& refuse);

}  // namespace carpus::image_formats
