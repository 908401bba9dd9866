// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Says why a file could not be written.
#pragma once

#include <filesystem>

namespace carpus::case_io {

/// Throws IoError: the file, that it could not be written, and how much room is left on its disk.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& file);

}  // namespace carpus::case_io
