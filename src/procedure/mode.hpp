// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace carpus::procedure {

/// Two ways to operate, told apart in recordings, records and score.
enum class Mode : std::uint8_t {
  Practice = 0,  ///< bones, hints and undo; the truth is at hand
  Assessed = 1,  ///< eyes on the C-arm: no bones, no hints, no undo; the truth comes afterwards
};
inline constexpr std::size_t kModeCount = 2;

/// "practice", "assessed": stable, for protocol and records.
[[nodiscard]] constexpr std::string_view name_of(Mode mode) noexcept {
  constexpr std::array<std::string_view, kModeCount> kNames{"practice", "assessed"};
  return kNames[static_cast<std::size_t>(mode) % kModeCount];
}
[[nodiscard]] constexpr std::optional<Mode> mode_of(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kModeCount; ++i) {
    if (name_of(static_cast<Mode>(i)) == name) return static_cast<Mode>(i);
  }
  return std::nullopt;
}

}  // namespace carpus::procedure
