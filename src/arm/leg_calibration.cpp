// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/leg_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::arm {
namespace {

constexpr std::size_t kFewestPoints = 4;
constexpr double kShortestRangeRad = 0.5;
/// 2 % of 340 degrees is 0.119 rad; the line takes most of a slow curve off.
constexpr double kWorstLineErrorRad = 0.15;
/// Of the wire: pi/8192 rad, and counts by the 4096.
constexpr double kRadPerUnit = kPi / 8192;
constexpr double kCountsOfGain = 4096;

/// What is left at `counts`, between the points a straight line, beyond them as at the last.
double residual_at(const std::vector<CalibrationPoint>& table, double counts) {
  if (table.empty()) return 0;
  if (!(counts > table.front().counts)) return table.front().angle_rad;
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (counts > table[i].counts) continue;
    const double share = (counts - table[i - 1].counts) / (table[i].counts - table[i - 1].counts);
    return table[i - 1].angle_rad + share * (table[i].angle_rad - table[i - 1].angle_rad);
  }
  return table.back().angle_rad;
}

}  // namespace

double LegCalibration::angle_at(double counts) const noexcept {
  return (counts - zero_counts) * rad_per_count + residual_at(residuals, counts);
}

double LegCalibration::line_angle_at(double angle) const noexcept {
  // The residual is small and slow: three rounds of taking it off where it is.
  double line = angle;
  for (int i = 0; i < 3; ++i) {
    line = angle - residual_at(residuals, zero_counts + line / rad_per_count);
  }
  return line;
}

Result<LegCalibration> calibrate_leg(std::span<const CalibrationPoint> points) {
  if (points.size() < kFewestPoints) {
    return Refusal{"a leg needs at least " + std::to_string(kFewestPoints) +
                   " points to be calibrated"};
  }
  std::vector<CalibrationPoint> sorted(points.begin(), points.end());
  for (const CalibrationPoint& point : sorted) {
    if (!std::isfinite(point.angle_rad) || !std::isfinite(point.counts)) {
      return Refusal{"a point of the calibration is no number"};
    }
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.counts < b.counts; });
  const bool rises = sorted.back().angle_rad > sorted.front().angle_rad;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (!(sorted[i].counts > sorted[i - 1].counts) ||
        (sorted[i].angle_rad > sorted[i - 1].angle_rad) != rises) {
      return Refusal{
          "the sensor does not turn one way with the leg: a loose wiper, or points mixed up"};
    }
  }
  if (std::abs(sorted.back().angle_rad - sorted.front().angle_rad) < kShortestRangeRad) {
    return Refusal{"the points lie within half a radian: turn the leg farther"};
  }
  double n = 0;
  double sum_c = 0;
  double sum_a = 0;
  for (const CalibrationPoint& point : sorted) {
    n += 1;
    sum_c += point.counts;
    sum_a += point.angle_rad;
  }
  double cc = 0;
  double ca = 0;
  for (const CalibrationPoint& point : sorted) {
    cc += (point.counts - sum_c / n) * (point.counts - sum_c / n);
    ca += (point.counts - sum_c / n) * (point.angle_rad - sum_a / n);
  }
  LegCalibration out;
  out.rad_per_count = ca / cc;
  out.zero_counts = sum_c / n - sum_a / n / out.rad_per_count;
  for (const CalibrationPoint& point : sorted) {
    const double left = point.angle_rad - (point.counts - out.zero_counts) * out.rad_per_count;
    out.residuals.push_back({left, point.counts});
    out.line_error_rad = std::max(out.line_error_rad, std::abs(left));
  }
  if (out.line_error_rad > kWorstLineErrorRad) {
    return Refusal{"the sensor is " +
                   std::to_string(std::lround(degrees_from_radians(out.line_error_rad))) +
                   " degrees off a straight line: a potentiometer of 2 % is at most 9"};
  }
  return out;
}

void put_line(const LegCalibration& calibration, firmware::LegConfig& config) noexcept {
  config.zero_counts =
      static_cast<std::uint16_t>(std::clamp(std::round(calibration.zero_counts), 0.0, 65535.0));
  config.gain = static_cast<std::int16_t>(std::clamp(
      std::round(calibration.rad_per_count * kCountsOfGain / kRadPerUnit), -32767.0, 32767.0));
}

}  // namespace carpus::arm
