// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// printf into a string: figures for people, where to_string has no digits to choose.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace carpus {

/// As printf, into a string of any length.
template <typename... Values>
[[nodiscard]] std::string format(const char* pattern, Values... values) {
  const int length = std::snprintf(nullptr, 0, pattern, values...);
  if (length <= 0) return {};
  std::string text(static_cast<std::size_t>(length), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

}  // namespace carpus
