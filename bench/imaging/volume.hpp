// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the kernels work on, in types that no library's header needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carpus::bench {

/// x runs fastest.
struct Volume {
  std::array<int, 3> size{};
  std::array<double, 3> spacing_mm{};
  std::vector<float> hu;
  std::vector<float> relief;             ///< length of the gradient
  std::vector<std::uint16_t> relief_12;  ///< the same in 4096 levels, monotone

  [[nodiscard]] std::size_t voxels() const { return hu.size(); }
};

}  // namespace carpus::bench
