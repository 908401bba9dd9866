// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Header, one block of data, end; each row unfiltered. Deflate and CRC are zlib's.
#include "case_io/png.hpp"

#include <zlib.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

std::string four_bytes(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<char>((value >> shift) & 0xFFU));
  }
  return bytes;
}

void add_chunk(std::string& file, std::string_view type, std::string_view data) {
  const std::string checked = std::string(type) + std::string(data);
  const auto crc =
      ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  file += four_bytes(static_cast<std::uint32_t>(data.size())) + checked +
          four_bytes(static_cast<std::uint32_t>(crc));
}

/// @param kind  the header's last five bytes: depth, colours, and three that are always 0.
/// @param palette  the whole chunk, or empty.
std::string png_of(int width,
                   int height,
                   std::string_view kind,
                   const std::string& palette,
                   std::span<const std::uint8_t> values) {
  const auto w = static_cast<std::size_t>(width);
  if (width <= 0 || height <= 0 || values.size() != w * static_cast<std::size_t>(height)) {
    throw InvalidInput("png: the picture's size does not agree with its values");
  }
  std::vector<Bytef> rows;
  for (std::size_t at = 0; at < values.size(); at += w) {
    rows.push_back(0);  // no filter
    rows.insert(rows.end(), values.begin() + static_cast<std::ptrdiff_t>(at),
                values.begin() + static_cast<std::ptrdiff_t>(at + w));
  }
  uLongf size = ::compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, rows.data(),
                  static_cast<uLong>(rows.size()), Z_BEST_COMPRESSION) != Z_OK) {
    throw InvalidInput("png: the picture could not be compressed");
  }
  packed.resize(size);
  std::string file = "\x89PNG\r\n\x1a\n";
  add_chunk(file, "IHDR",
            four_bytes(static_cast<std::uint32_t>(width)) +
                four_bytes(static_cast<std::uint32_t>(height)) + std::string(kind));
  if (!palette.empty()) add_chunk(file, "PLTE", palette);
  add_chunk(file, "IDAT", packed);
  add_chunk(file, "IEND", "");
  return file;
}

}  // namespace

std::string png_of_grey(int width, int height, std::span<const std::uint8_t> grey) {
  return png_of(width, height, std::string_view("\x08\x00\x00\x00\x00", 5), "", grey);
}

std::string png_of_indexed(int width,
                           int height,
                           std::span<const std::array<std::uint8_t, 3>> palette,
                           std::span<const std::uint8_t> indices) {
  if (palette.empty() || palette.size() > 256 ||
      std::any_of(indices.begin(), indices.end(),
                  [&](std::uint8_t index) { return index >= palette.size(); })) {
    throw InvalidInput("png: a value without a colour");
  }
  std::string colours;
  for (const auto& colour : palette) colours.append(colour.begin(), colour.end());
  return png_of(width, height, std::string_view("\x08\x03\x00\x00\x00", 5), colours, indices);
}

}  // namespace carpus::case_io
