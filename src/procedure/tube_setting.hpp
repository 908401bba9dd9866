// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the C-arm's tube can be set to, and what a pulse of it costs. Whole numbers: doses add up
// the same everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carpus::procedure {

/// A place in both tables below: 3 * voltage + dose.
using TubeSetting = std::uint8_t;

inline constexpr std::array<std::uint32_t, 3> kTubeKv{50, 60, 70};
/// Halves of the usual dose: low, usual, high [E].
inline constexpr std::array<std::uint32_t, 3> kDoseHalves{1, 2, 4};
inline constexpr TubeSetting kTubeSettings = 9;
inline constexpr TubeSetting kUsualTube = 4;  ///< 60 kV, usual dose

[[nodiscard]] constexpr std::size_t voltage_of(TubeSetting setting) noexcept {
  return setting / kDoseHalves.size() % kTubeKv.size();
}
[[nodiscard]] constexpr std::size_t dose_level_of(TubeSetting setting) noexcept {
  return setting % kDoseHalves.size();
}

/// The same current gives more at a higher voltage, by its square.
[[nodiscard]] constexpr std::uint32_t dose_units(TubeSetting setting) noexcept {
  const std::uint32_t tens_of_kv = kTubeKv[voltage_of(setting)] / 10;
  return tens_of_kv * tens_of_kv * kDoseHalves[dose_level_of(setting)];
}
inline constexpr std::uint32_t kUsualDoseUnits = dose_units(kUsualTube);

}  // namespace carpus::procedure
