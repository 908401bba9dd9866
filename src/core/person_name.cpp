// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/person_name.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

namespace carpus {

namespace {

constexpr std::uint32_t kMalformed = 0xFFFFFFFF;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Takes one code point off `rest`, which is not empty.
std::uint32_t take_code_point(std::string_view& rest) {
  const auto first = static_cast<unsigned char>(rest.front());
  const std::size_t size = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  const bool starts_one = first < 0x80 || (first >= 0xC2 && first < 0xF5);
  if (!starts_one || rest.size() < size) return kMalformed;
  std::uint32_t code = size == 1 ? first : first & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if (!is_continuation(rest[i])) return kMalformed;
    code = code << 6U | (static_cast<unsigned char>(rest[i]) & 0x3FU);
  }
  rest.remove_prefix(size);
  return code;
}

bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

bool turns_direction(std::uint32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string sentence(const char* what, std::uint32_t code) {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "U+%04X", static_cast<unsigned>(code));
  return std::string("The name has ") + what + " (" + number.data() + "); remove it.";
}

}  // namespace

std::optional<std::string> problem_of_name(std::string_view utf8) {
  while (!utf8.empty()) {
    const std::uint32_t code = take_code_point(utf8);
    if (code == kMalformed) return "The name is not text in UTF-8; type it anew.";
    if (is_control(code)) return sentence("a line break or another control character", code);
    if (turns_direction(code)) {
      return sentence("an invisible character that turns the direction of writing", code);
    }
  }
  return std::nullopt;
}

}  // namespace carpus
