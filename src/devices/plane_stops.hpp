// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Local planes as stops of drive A's legs: where the legs would be if the tip stood on the plane,
// and which way each may not go beyond. One plane at a time: the one that the tip is nearest to or
// deepest in.
#pragma once

#include "arm/delta_arm.hpp"
#include "devices/arm_calibration.hpp"
#include "devices/device.hpp"
#include "firmware/core/wire.hpp"

namespace carpus::devices {

/// Farther from the plane than this all legs are free: a stop that follows far away costs force.
inline constexpr double kStopReachMm = 12.0;
/// Legs that a move along the normal turns less than this share of the most turned one stay free:
/// their stops would only rub.
inline constexpr double kLeastShareOfTurn = 0.35;

/// @param tip  in the frame of the arm (arm/delta_arm.hpp) [mm], as the planes.
[[nodiscard]] firmware::Stop stops_of(const arm::DeltaArm& arm,
                                      const std::array<arm::LegCalibration, kLegs>& legs,
                                      const Vec3& tip,
                                      const DeviceCommand& command) noexcept;

}  // namespace carpus::devices
