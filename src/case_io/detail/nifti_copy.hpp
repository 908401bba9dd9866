// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The words that a NIfTI file says about itself: its header's `descrip`, which ITK 5.2 does not
// write.
#pragma once

#include <filesystem>
#include <string>

namespace carpus::case_io {

/// Copies the NIfTI `from` to `file`, compressed where its name ends with .gz, with the
/// description's first 79 bytes in the header.
/// @throws IoError where `file` cannot be written whole.
void copy_nifti_with_description(const std::filesystem::path& from,
                                 const std::filesystem::path& file,
                                 const std::string& description);

}  // namespace carpus::case_io
