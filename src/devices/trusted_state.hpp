// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether what a driver says of its device can be: the last line before the trainer.
#pragma once

#include <cmath>

#include "devices/device.hpp"

namespace carpus::devices {

/// No device of a hand reaches farther from its middle, or goes faster.
inline constexpr double kFarthestMm = 2000;
inline constexpr double kFastestMmPerS = 20'000;
inline constexpr double kFastestRadPerS = 100;

[[nodiscard]] inline bool is_sound(const DeviceState& state) noexcept {
  if (!is_finite(state.position_mm) || !is_finite(state.velocity_mm_s) ||
      !is_finite(state.spin_rad_s) || !is_finite(state.force_n)) {
    return false;
  }
  const Mat3 product = state.rotation * state.rotation.transposed();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(std::abs(product.rows[i][k] - (i == k ? 1.0 : 0.0)) < 1e-3)) return false;
    }
  }
  return state.rotation.determinant() > 0 && length(state.position_mm) < kFarthestMm &&
         length(state.velocity_mm_s) < kFastestMmPerS && length(state.spin_rad_s) < kFastestRadPerS;
}

}  // namespace carpus::devices
