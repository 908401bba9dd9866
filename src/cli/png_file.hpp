// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A colour picture, and PNG through libpng.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace carpus::cli {

/// Rows from the top; red, green, blue, 8 bits each.
struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height
};

/// @throws IoError where the file cannot be written.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace carpus::cli
