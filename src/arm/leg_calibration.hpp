// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a leg's sensor says at known angles, turned into angles: the best straight line, which the
// firmware is given, and a table of what is left of the potentiometer's curve, which the host takes
// off.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "firmware/core/wire.hpp"

namespace carpus::arm {

/// The leg held at a known angle, by the calibration gauge's notches or a fitted pose.
struct CalibrationPoint {
  double angle_rad = 0;
  double counts = 0;
};

struct LegCalibration {
  double zero_counts = 0;
  double rad_per_count = 0;
  /// Angle less the line's, at the points, by ascending counts.
  std::vector<CalibrationPoint> residuals;
  /// Greatest error of the line alone [rad].
  double line_error_rad = 0;

  [[nodiscard]] double angle_at(double counts) const noexcept;
  /// The angle that the firmware, which has the line alone, believes where the leg truly is at
  /// `angle`: stops are sent so.
  [[nodiscard]] double line_angle_at(double angle) const noexcept;
};

/// @param points  at least four, over at least half a radian. Refuses what is no line: neighbours
/// out of order, or a curve that is worse than a potentiometer of 2 % can be.
[[nodiscard]] Result<LegCalibration> calibrate_leg(std::span<const CalibrationPoint> points);

/// The line for the firmware; the rest of the frame stays as it is.
void put_line(const LegCalibration& calibration, firmware::LegConfig& config) noexcept;

}  // namespace carpus::arm
