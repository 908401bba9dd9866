// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace carpus::case_io {

/// A grey picture of 8 bits as the bytes of a PNG file.
/// @param grey  row by row from the top, width * height values.
/// @throws InvalidInput where the sizes do not agree or are not positive.
[[nodiscard]] std::string png_of_grey(int width, int height, std::span<const std::uint8_t> grey);

/// A picture of up to 256 colours, each red, green and blue.
/// @param indices  into the palette, row by row from the top.
/// @throws InvalidInput as png_of_grey, and where an index has no colour.
[[nodiscard]] std::string png_of_indexed(int width,
                                         int height,
                                         std::span<const std::array<std::uint8_t, 3>> palette,
                                         std::span<const std::uint8_t> indices);

}  // namespace carpus::case_io
