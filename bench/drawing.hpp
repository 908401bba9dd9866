// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Plots as files: SVG to print, and the same as PNG to look at.
#pragma once

#include <filesystem>
#include <string>

namespace carpus::bench {

/// Writes `svg` to `file`, and as PNG beside it (same name, .png, two pixels for each unit of
/// its view box) where the program was built with librsvg.
/// @throws InvalidInput if the drawing is empty, IoError if a file could not be written.
void save_drawing(const std::filesystem::path& file, const std::string& svg);

}  // namespace carpus::bench
