// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a NIfTI file is all there: the NIfTI library fills what is missing with zeros and says
// nothing to its caller.
#pragma once

#include <filesystem>

namespace carpus::case_io {

/// Reads a .nii or .nii.gz to its end (checking the checksum of a compressed one) and compares its
/// length with its header. @throws IoError where it is not NIfTI, damaged or cut short.
void check_nifti_is_whole(const std::filesystem::path& file);

}  // namespace carpus::case_io
