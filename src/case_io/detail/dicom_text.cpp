// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/dicom_text.hpp"

#include <array>
#include <cstdio>

#include "core/rng.hpp"

namespace carpus::case_io {

std::string uid_from(std::uint64_t seed) {
  Rng rng(seed);
  __extension__ using Wide = unsigned __int128;
  const std::uint64_t high = (rng.next() & ~0xF000ULL) | 0x4000ULL;         // version 4
  const std::uint64_t low = (rng.next() & ~(3ULL << 62U)) | (2ULL << 62U);  // variant 1
  Wide number = (static_cast<Wide>(high) << 64U) | low;
  std::string digits;
  for (; number != 0; number /= 10) {
    digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(number % 10)));
  }
  return "2.25." + digits;
}

std::string decimal(double v) {
  std::array<char, 40> buffer{};
  int digits = 12;
  int length = 0;
  do {
    length = std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, v == 0 ? 0.0 : v);
  } while (length > 16 && --digits > 0);
  return std::string(buffer.data(), static_cast<std::size_t>(length));
}

}  // namespace carpus::case_io
