// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What helps in practice, on request: counted, and told with the score. An assessed operation has
// none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace carpus::procedure {

enum class Aid : std::uint8_t {
  Ghost = 0,    ///< the ideal line and screw are drawn
  Section = 1,  ///< the bones are cut open
  Hint = 2,     ///< what to change, in words
};
inline constexpr std::size_t kAidCount = 3;

[[nodiscard]] inline std::string in_words(Aid aid) {
  constexpr std::array<std::string_view, kAidCount> kWords{"ghost of the ideal", "cut planes",
                                                           "hints"};
  return std::string(kWords[static_cast<std::size_t>(aid) % kAidCount]);
}

}  // namespace carpus::procedure
