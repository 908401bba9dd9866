// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/potentiometer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "arm/leg_calibration.hpp"
#include "core/units.hpp"

namespace carpus::arm {
namespace {

constexpr double kLeast = -1.012;
constexpr double kMost = 1.367;

/// A leg held in the notches of a gauge, each read for 64 conversions.
std::vector<CalibrationPoint> points_of(Potentiometer& pot, int notches) {
  std::vector<CalibrationPoint> points;
  for (int i = 0; i < notches; ++i) {
    CalibrationPoint point;
    point.angle_rad = kLeast + (kMost - kLeast) * i / (notches - 1);
    for (int k = 0; k < 64; ++k)
      point.counts += 4.0 * counts_of(pot.read(point.angle_rad), 10) / 64;
    points.push_back(point);
  }
  return points;
}

TEST(Potentiometer, RisesAlongItsTravelWithinItsLinearity) {
  const PotentiometerKind kind;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Potentiometer pot(kind, seed);
    double last = pot.share_at(-3.2);
    for (double angle = -3.1; angle < 3.1; angle += 0.01) {
      const double share = pot.share_at(angle);
      EXPECT_GE(share, last);
      last = share;
      const double ideal = std::clamp(angle / kind.travel_rad + 0.5, 0.0, 1.0);
      EXPECT_NEAR(share, ideal,
                  kind.linearity + kind.end_share + 0.5 * kind.travel_spread_rad / kind.travel_rad);
    }
    EXPECT_NEAR(last, 1 - kind.end_share, 1e-9);
  }
}

TEST(Potentiometer, CalibrationTakesItsCurveOff) {
  double worst_line = 0;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Potentiometer pot({}, seed);
    const auto calibration = calibrate_leg(points_of(pot, 13));
    ASSERT_TRUE(calibration) << calibration.error();
    worst_line = std::max(worst_line, calibration->line_error_rad);
    for (double angle = kLeast; angle < kMost; angle += 0.013) {
      double counts = 0;
      for (int k = 0; k < 16; ++k) counts += 4.0 * counts_of(pot.read(angle), 10) / 16;
      worst = std::max(worst, std::abs(calibration->angle_at(counts) - angle));
      const double line = (counts - calibration->zero_counts) * calibration->rad_per_count;
      EXPECT_NEAR(calibration->line_angle_at(angle), line, radians_from_degrees(0.6));
    }
  }
  EXPECT_GT(worst_line, radians_from_degrees(1.5)) << "or there would be nothing to take off";
  EXPECT_LT(worst, radians_from_degrees(0.6));
}

TEST(LegCalibration, GivesTheFirmwareItsLine) {
  std::vector<CalibrationPoint> points;
  for (int i = 0; i < 8; ++i)
    points.push_back({0.2 * i - 0.6, 2000 + 0.2 * i / (kPi / 8192) / 3.7});
  const auto calibration = calibrate_leg(points);
  ASSERT_TRUE(calibration);
  firmware::LegConfig config;
  put_line(*calibration, config);
  for (const CalibrationPoint& point : points) {
    const double units = (point.counts - config.zero_counts) * config.gain / 4096.0;
    EXPECT_NEAR(units * kPi / 8192, point.angle_rad, 1e-3);
  }
}

TEST(LegCalibration, RefusesWhatIsNoSensor) {
  std::vector<CalibrationPoint> points{{-0.5, 1000}, {0, 1400}, {0.5, 1800}};
  EXPECT_FALSE(calibrate_leg(points)) << "too few";
  points.push_back({1.0, 1700});
  EXPECT_FALSE(calibrate_leg(points)) << "turns back";
  points.back() = {0.6, 4000};
  EXPECT_FALSE(calibrate_leg(points)) << "far off a line";
  points.back() = {1.0, std::nan("")};
  EXPECT_FALSE(calibrate_leg(points));
  points = {{0.0, 1000}, {0.1, 1100}, {0.2, 1200}, {0.3, 1300}};
  EXPECT_FALSE(calibrate_leg(points)) << "too little of its travel";
}

TEST(Card, ReadsEachRangeToItsLeastBit) {
  for (const CardRange range :
       {CardRange::PlusMinus10V, CardRange::PlusMinus5V, CardRange::To10V, CardRange::To5V}) {
    const double low = card_volts(0, range);
    const double high = card_volts(4095, range);
    const double bit = (high - low) / 4095;
    for (double volts = low; volts < high; volts += 0.0371) {
      EXPECT_NEAR(card_volts(card_counts(volts, range), range), volts, bit / 2 + 1e-12);
    }
    EXPECT_EQ(card_counts(16, range), 4095);
    EXPECT_EQ(card_counts(-16, range), 0);
  }
  EXPECT_NEAR(card_volts(4095, CardRange::To5V), 5.0, 0.001);
  EXPECT_NEAR(card_volts(0, CardRange::PlusMinus10V), -10.0, 0.003);
}

TEST(Servo, TakesThePulsesOfTheThesis) {
  EXPECT_DOUBLE_EQ(servo_pulse_ms(90), 1.5);
  EXPECT_DOUBLE_EQ(servo_angle_deg(1.0), 0);
  EXPECT_DOUBLE_EQ(servo_angle_deg(2.0), 180);
  EXPECT_DOUBLE_EQ(servo_angle_deg(3.0), 180);
  for (double angle = 0; angle <= 180; angle += 7.5)
    EXPECT_NEAR(servo_angle_deg(servo_pulse_ms(angle)), angle, 1e-9);
}

}  // namespace
}  // namespace carpus::arm
