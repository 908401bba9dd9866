// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Says why a file could not be written.
#pragma once

#include <filesystem>
#include <string>

namespace carpus::case_io {

/// Throws IoError: the file, that it could not be written, how much room is left on its disk, and
/// `sign`: what showed it, where that may tell more.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& file,
                                     const std::string& sign = {});

}  // namespace carpus::case_io
