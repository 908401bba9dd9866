// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that are whole or not there: written under a temporary name in the same folder, flushed to
// the disk, then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace carpus::records {

/// Whether nothing is there, or a plain file: what is renamed to /dev/null or /dev/stdout by root
/// takes the device's place, for every program.
[[nodiscard]] bool is_replaceable(const std::filesystem::path& file);

/// Replaces or creates `file`, which is_replaceable.
/// @throws IoError  saying what to do; whatever was there before is still there.
void write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> content);
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// The same where another writer opens files by name: it gets a temporary one in the same folder
/// that ends like `file`, so that a format chosen by the extension is the same.
void write_file_atomically(const std::filesystem::path& file,
                           const std::function<void(const std::filesystem::path&)>& write);

/// The whole content of a file.
/// @throws IoError  where there is none or it cannot be read.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& file);

}  // namespace carpus::records
