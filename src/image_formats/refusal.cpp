// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "image_formats/refusal.hpp"

#include <array>
#include <charconv>

#include "core/error.hpp"

namespace carpus::image_formats {

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string shown;
  for (const char c : text.substr(0, kLongest)) shown += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > kLongest ? shown + "..." : shown;
}

std::string printable(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

void Refuser::damaged(std::string_view field,
                      std::string_view found,
                      std::string_view needed) const {
  throw IoError(file_ + ": " + std::string(field) + " is " + std::string(found) + ", " +
                std::string(needed) + "; it is damaged: copy it again from its source");
}

void Refuser::cut_short(std::string_view what) const {
  throw IoError(file_ + ": is cut short: " + std::string(what) +
                " runs past its end; copy it again from its source");
}

void Refuser::unusable(std::string_view field,
                       std::string_view found,
                       std::string_view what_to_do) const {
  throw InvalidInput(file_ + ": " + std::string(field) + " is " + std::string(found) + "; " +
                     std::string(what_to_do));
}

}  // namespace carpus::image_formats
