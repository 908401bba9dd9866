// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// MetaImage (.mha) and its header with the voxels in a file beside it (.mhd).
#pragma once

#include <string_view>

#include "image_formats/volume_header.hpp"

namespace carpus::image_formats {

/// Reads the front of a file: three dimensions, one number a voxel, binary, plain or zlib. Place
/// and direction must be said, because without them left and right are not known; where
/// AnatomicalOrientation is said too, it must agree with the matrix.
/// @param front  the file's first kLongestHeaderText bytes, or all of it.
/// @throws IoError, InvalidInput  as Refuser says. Source: [metaio_format].
[[nodiscard]] VolumeHeader parse_meta_image(std::string_view front, const Refuser& refuse);

}  // namespace carpus::image_formats
