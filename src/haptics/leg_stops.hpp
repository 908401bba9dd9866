// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact for drive A, whose legs can be stopped but not pushed: the legs' angles at the place on
// the surface where the tip may be, each closed to the side that leads into the bone. Legs that the
// surface's normal hardly turns stay free, or sliding would rub. The firmware leads free legs and
// fades that lead before the stop; what the host leads is the slide along the surface.
#pragma once

#include <array>

#include "arm/delta_arm.hpp"
#include "arm/leg_calibration.hpp"
#include "firmware/core/wire.hpp"
#include "haptics/local_planes.hpp"

namespace carpus::haptics {

/// A leg that turns less than this share of the one that turns most is left free.
inline constexpr double kLeastTurnShare = 0.35;
/// Of the slide along the surface [s]: longer, and stops pump energy into the hand.
inline constexpr double kSlideLeadS = 0.025;
/// A surface farther than this is no matter yet [mm].
inline constexpr double kNearSurfaceMm = 25;

/// @param calibrations  of the legs: stops are sent in the line that the firmware knows.
/// @param tip, velocity  in the device's frame [mm], [mm/s]. All legs free where the plane is far,
/// out of reach or not finite. Real-time.
[[nodiscard]] firmware::Stop leg_stops(const arm::DeltaArm& arm,
                                       const std::array<arm::LegCalibration, 3>& calibrations,
                                       const SurfacePlane& plane,
                                       const Vec3& tip,
                                       const Vec3& velocity) noexcept;

}  // namespace carpus::haptics
