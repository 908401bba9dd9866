// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/json_nesting.hpp"

#include <cstddef>

namespace carpus {

bool nests_deeper_than(std::string_view text, int most) noexcept {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        in_string = false;
      }
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > most) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

}  // namespace carpus
