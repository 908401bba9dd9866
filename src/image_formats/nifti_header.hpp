// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// NIfTI-1 in one file (.nii, unpacked .nii.gz).
#pragma once

#include <cstddef>
#include <span>

#include "image_formats/volume_header.hpp"

namespace carpus::image_formats {

/// Header and the four bytes that say whether extensions follow.
inline constexpr std::size_t kNiftiFrontBytes = 352;

/// Reads the front of an unpacked NIfTI. Where qform, sform and pixdim say the same thing twice
/// they must agree; one of the two forms must be there, because without it left and right are not
/// known.
/// @param front  kNiftiFrontBytes; fewer are refused.
/// @return `packing` is Raw and stored_begins the voxels' place in the unpacked stream.
/// @throws IoError, InvalidInput  as Refuser says. Source: [nifti1_h].
[[nodiscard]] VolumeHeader parse_nifti(std::span<const std::byte> front, const Refuser& refuse);

}  // namespace carpus::image_formats
