// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// When two pictures are two views, and what a picture costs. Plain comparisons: safe in the tick.
#pragma once

#include <cstdint>

#include "procedure/situation.hpp"

namespace carpus::procedure {

/// Two shots count as different views when rotation or tilt differ by at least this much [E].
inline constexpr double kDifferentViewDeg = 20.0;

/// How far from its nominal angles a shot may be taken and still count as a view [deg] [E].
inline constexpr double kViewToleranceDeg = 15.0;

/// Dose-area product of one shot at the usual setting [cGy cm2], an engineering figure: five
/// seconds of a mini C-arm at 0.1 mA (fluoroscopy/detector.hpp); a whole conventional operation
/// takes 45.6 cGy cm2 [navigatedndscaphoid].
inline constexpr double kDosePerShotCgyCm2 = 0.5;

/// Of so many pulses' dose_units.
[[nodiscard]] constexpr double dose_cgy_cm2(std::uint64_t units) noexcept {
  return kDosePerShotCgyCm2 * static_cast<double>(units) / (kPulsesPerShot * kUsualDoseUnits);
}

[[nodiscard]] constexpr std::uint64_t dose_units_of(const Shot& shot) noexcept {
  return std::uint64_t{shot.pulses} * dose_units(shot.tube);
}

[[nodiscard]] constexpr bool is_near_angle(double value_deg,
                                           double nominal_deg,
                                           double tolerance_deg = kViewToleranceDeg) noexcept {
  return value_deg >= nominal_deg - tolerance_deg && value_deg <= nominal_deg + tolerance_deg;
}

/// In (-90, 90]: a picture from the other side shows the same contours.
[[nodiscard]] constexpr double folded_rotation_deg(double rotation_deg) noexcept {
  if (rotation_deg > 90) return rotation_deg - 180;
  if (rotation_deg <= -90) return rotation_deg + 180;
  return rotation_deg;
}

[[nodiscard]] constexpr bool are_different_views(const Shot& a, const Shot& b) noexcept {
  const double rotation = a.rotation_deg - b.rotation_deg;
  const double tilt = a.tilt_deg - b.tilt_deg;
  return rotation >= kDifferentViewDeg || -rotation >= kDifferentViewDeg ||
         tilt >= kDifferentViewDeg || -tilt >= kDifferentViewDeg;
}

/// Bit of a step in completed_steps.
[[nodiscard]] constexpr bool is_completed(std::uint32_t completed_steps,
                                          std::size_t step) noexcept {
  return (completed_steps >> step & 1U) != 0;
}

}  // namespace carpus::procedure
