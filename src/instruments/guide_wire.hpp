// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The guide wire: 0.045 in (1.14 mm), trocar tip at both ends [clinical: S1, B1].
#pragma once

#include <algorithm>

namespace carpus::instruments {

inline constexpr double kWireRadiusMm = 0.57;

/// From the tip, where the radius is 0, to the full radius [mm]; a trocar tip is about 1.5 mm long.
inline constexpr double kWireTipLengthMm = 1.5;

/// Length of wire that sticks out of the driver and can meet bone [mm].
inline constexpr double kWireLengthMm = 80.0;

/// Radius at a distance from the tip along the shaft [mm].
[[nodiscard]] constexpr double wire_radius_at(double from_tip_mm) noexcept {
  return kWireRadiusMm * std::clamp(from_tip_mm / kWireTipLengthMm, 0.0, 1.0);
}

}  // namespace carpus::instruments
