// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that a run leaves: asked for before it, and whole or not there at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace carpus::bench {

/// Before a run of minutes: can this file be written? Nothing is created.
/// @throws IoError naming the folder that is missing or read only.
void check_writable(const std::filesystem::path& file);

/// `write` fills a file beside `file`, which then takes its place.
/// @throws whatever `write` throws, IoError if the place could not be taken; nothing is left then.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path& part)>& write);

/// The text as a file.
/// @throws IoError where it cannot be written; an earlier file is then left as it was.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace carpus::bench
