// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/png.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

TEST(Png, HoldsTheValuesAndAgreesWithItsChecks) {
  const std::vector<std::uint8_t> grey{0, 50, 100, 150, 200, 255};
  const std::string file = png_of_grey(3, 2, grey);
  EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto number = [&](std::size_t at) {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) n = n << 8U | static_cast<std::uint8_t>(file[at + i]);
    return n;
  };
  std::string names;
  std::string data;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number(at);
    names += file.substr(at + 4, 4) + " ";
    if (file.substr(at + 4, 4) == "IDAT") data = file.substr(at + 8, size);
    const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(file.data() + at + 4),
                             static_cast<uInt>(size + 4));
    EXPECT_EQ(number(at + 8 + size), crc);
    at += size + 12;
  }
  EXPECT_EQ(names, "IHDR IDAT IEND ");
  EXPECT_EQ(number(16), 3U);
  EXPECT_EQ(number(20), 2U);
  std::array<Bytef, 8> rows{};
  uLongf size = rows.size();
  ASSERT_EQ(::uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(data.data()),
                         static_cast<uLong>(data.size())),
            Z_OK);
  EXPECT_EQ(rows, (std::array<Bytef, 8>{0, 0, 50, 100, 0, 150, 200, 255}));
}

TEST(Png, HoldsColoursBeforeTheValuesThatNameThem) {
  const std::vector<std::array<std::uint8_t, 3>> palette{{1, 2, 3}, {4, 5, 6}};
  const std::vector<std::uint8_t> indices{0, 1};
  const std::string file = png_of_indexed(2, 1, palette, indices);
  EXPECT_EQ(file[25], 3);  // the header's kind of colours
  EXPECT_EQ(file.substr(37, 10), "PLTE\x01\x02\x03\x04\x05\x06");
  EXPECT_THROW((void)png_of_indexed(1, 1, palette, std::vector<std::uint8_t>{2}), InvalidInput);
}

TEST(Png, RefusesSizesThatDoNotAgree) {
  const std::vector<std::uint8_t> grey(6);
  EXPECT_THROW((void)png_of_grey(2, 2, grey), InvalidInput);
  EXPECT_THROW((void)png_of_grey(0, 2, {}), InvalidInput);
}

}  // namespace
}  // namespace carpus::case_io
