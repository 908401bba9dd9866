// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Inputs are whole multiples of small units, so that a recording is small and holds exactly what
// the world was given. Units are powers of two: a multiple of one is exact in a double.
#pragma once

#include <cstdint>

namespace carpus::simulation {

inline constexpr double kPositionUnitMm = 1.0 / 1024;
inline constexpr double kDirectionUnit = 1.0 / 16384;  ///< of a vector's component: 0.004 degrees
inline constexpr double kAngleUnitRad = 1.0 / 16384;
inline constexpr double kForceUnitN = 1.0 / 64;
inline constexpr double kViewUnitDeg = 1.0 / 64;

/// Beyond this many units, and where it is not finite, a value is no input: it becomes one more
/// than this, for the world to refuse.
inline constexpr double kMostUnits = 1e9;
inline constexpr std::int64_t kNoInputUnits = 1'000'000'001;

/// Nearest number of units, halves away from zero.
[[nodiscard]] constexpr std::int64_t units_of(double value, double unit) noexcept {
  const double units = value / unit;
  if (!(units >= -kMostUnits && units <= kMostUnits)) return kNoInputUnits;
  return static_cast<std::int64_t>(units < 0 ? units - 0.5 : units + 0.5);
}

[[nodiscard]] constexpr double quantised(double value, double unit) noexcept {
  return static_cast<double>(units_of(value, unit)) * unit;
}

}  // namespace carpus::simulation
