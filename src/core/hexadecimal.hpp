// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers as state hashes and fingerprints are written everywhere.
#pragma once

#include <cstdint>
#include <string>

namespace carpus {

/// Sixteen hexadecimal digits, lower case.
[[nodiscard]] inline std::string hexadecimal(std::uint64_t value) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4U) text[i] = kDigits[value & 15U];
  return text;
}

}  // namespace carpus
