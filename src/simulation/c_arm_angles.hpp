// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Angles of the C-arm as it stands in the room, from the forearm as scanned, and from the forearm
// as it is held (fluoroscopy/c_arm.hpp). Plain arithmetic: safe in the tick.
#pragma once

#include "core/units.hpp"

namespace carpus::simulation {

/// How far the C-arm turns and tilts in the room [deg].
inline constexpr double kGreatestRotationDeg = 180.0;
inline constexpr double kGreatestTiltDeg = 60.0;

/// Whether it can stand so. False for what is not a number.
[[nodiscard]] constexpr bool can_stand(double rotation_deg, double tilt_deg) noexcept {
  return rotation_deg >= -kGreatestRotationDeg && rotation_deg <= kGreatestRotationDeg &&
         tilt_deg >= -kGreatestTiltDeg && tilt_deg <= kGreatestTiltDeg;
}

/// In (-180, 180], for angles that are no farther out than one turn.
[[nodiscard]] constexpr double wrapped_deg(double angle_deg) noexcept {
  if (angle_deg > 180.0) return angle_deg - 360.0;
  return angle_deg <= -180.0 ? angle_deg + 360.0 : angle_deg;
}

/// From which side the held forearm is seen when the C-arm stands so. Under a source that keeps
/// still, pronation takes a forearm from lateral (90) over the pronated obliques to PA (0).
[[nodiscard]] constexpr double held_rotation_deg(double room_rotation_deg,
                                                 double pronation_rad) noexcept {
  return wrapped_deg(room_rotation_deg - degrees_from_radians(pronation_rad));
}

/// The reverse: how the C-arm must stand.
[[nodiscard]] constexpr double room_rotation_deg(double held_rotation_deg,
                                                 double pronation_rad) noexcept {
  return wrapped_deg(held_rotation_deg + degrees_from_radians(pronation_rad));
}

}  // namespace carpus::simulation
