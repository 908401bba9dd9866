// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What ITK 5.2 does not do for a NIfTI file: words in its header's `descrip`, and packing that is
// quick.
#pragma once

#include <filesystem>
#include <string>

namespace carpus::case_io {

/// Copies the NIfTI `from` to `file`, packed by gzip where its name ends with .gz, with the
/// description's first 79 bytes in the header. Packed at the least of effort: a CT is noise, which
/// more of it makes 3 % smaller in three times the time (0.9 s of a case's 5).
/// @throws IoError where `file` cannot be written whole.
void copy_nifti(const std::filesystem::path& from,
                const std::filesystem::path& file,
                const std::string& description);

}  // namespace carpus::case_io
