// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a place of soft tissue goes with the bones about it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carpus::arthroscopy {

/// With which bodies a place goes, and how far with each: 1 in all.
struct Carried {
  static constexpr std::size_t kMost = 4;
  std::array<std::uint8_t, kMost> body{};  ///< the foremost first
  std::array<float, kMost> share{};
};

}  // namespace carpus::arthroscopy
