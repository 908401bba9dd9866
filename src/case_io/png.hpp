// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace carpus::case_io {

/// A grey picture of 8 bits as the bytes of a PNG file.
/// @param grey  row by row from the top, width * height values.
/// @throws InvalidInput where the sizes do not agree or are not positive.
[[nodiscard]] std::string png_of_grey(int width, int height, std::span<const std::uint8_t> grey);

}  // namespace carpus::case_io
