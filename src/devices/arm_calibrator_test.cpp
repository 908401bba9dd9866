// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/arm_calibrator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm/potentiometer.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "devices/fake_arm_test_support.hpp"

namespace carpus::devices {
namespace {

using Samples = std::vector<std::array<std::int32_t, kLegs>>;

/// Three potentiometers of the thesis's kind, read as drive A's board does.
class Sensors {
 public:
  [[nodiscard]] std::int32_t read(std::size_t leg, double angle) {
    std::int32_t sum = 0;
    for (int i = 0; i < 4; ++i) sum += arm::counts_of(pots_[leg].read(angle), 10);
    return sum;
  }
  [[nodiscard]] Samples hold(std::size_t leg, double angle, double tremor = 0) {
    Samples samples;
    for (std::size_t i = 0; i < kSamplesOfStep; ++i) {
      std::array<std::int32_t, kLegs> sample{};
      for (std::size_t k = 0; k < kLegs; ++k) {
        const double off = k == leg ? angle + tremor * std::sin(0.1 * static_cast<double>(i)) : 0.5;
        sample[k] = read(k, off);
      }
      samples.push_back(sample);
    }
    return samples;
  }

 private:
  std::array<arm::Potentiometer, kLegs> pots_{arm::Potentiometer{{}, 1}, arm::Potentiometer{{}, 2},
                                              arm::Potentiometer{{}, 3}};
};

TEST(ArmCalibrator, DriveAIsGuidedThroughAllNotchesToSixTenthsOfADegree) {
  Sensors sensors;
  ArmCalibrator calibrator(firmware::Drive::Stop, 5);
  EXPECT_EQ(calibrator.step_count(), 18U);
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    for (const double notch : kGaugeDeg) {
      const std::string asked = calibrator.instruction();
      EXPECT_NE(asked.find("Leg " + std::to_string(leg + 1)), std::string::npos);
      EXPECT_NE(asked.find(std::to_string(static_cast<int>(notch)) + " deg"), std::string::npos);
      const double angle = radians_from_degrees(notch);
      // A hand that trembles is told, and the step stays.
      const auto problem = calibrator.take(sensors.hold(leg, angle, 0.05));
      ASSERT_TRUE(problem.has_value());
      EXPECT_NE(problem->find("keep it still"), std::string::npos);
      EXPECT_EQ(calibrator.take(sensors.hold(leg, angle)), std::nullopt);
    }
  }
  ASSERT_TRUE(calibrator.is_complete());
  const auto made = calibrator.finish("now");
  ASSERT_TRUE(made.has_value());
  EXPECT_EQ(made->unit, 5U);
  double worst = 0;
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    for (double deg = -40; deg <= 60; deg += 7) {
      const double angle = radians_from_degrees(deg);
      double sum = 0;
      for (int i = 0; i < 50; ++i) sum += made->legs[leg].angle_at(sensors.read(leg, angle));
      worst = std::max(worst, std::abs(sum / 50 - angle));
    }
  }
  EXPECT_LT(degrees_from_radians(worst), 0.6);
}

TEST(ArmCalibrator, NotchesMixedUpAreToldAndBeginAnew) {
  Sensors sensors;
  ArmCalibrator calibrator(firmware::Drive::Stop, 5);
  for (std::size_t step = 0; step < 18; ++step) {
    const std::size_t notch = step == 2 ? 3 : (step == 3 ? 2 : step % 6);
    const double angle = radians_from_degrees(kGaugeDeg[notch]);
    ASSERT_EQ(calibrator.take(sensors.hold(step / 6, angle)), std::nullopt);
  }
  const auto made = calibrator.finish("now");
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().find("Leg 1"), std::string::npos);
  EXPECT_EQ(calibrator.step(), 0U);
  EXPECT_NE(calibrator.take({}), std::nullopt);
}

TEST(ArmCalibrator, DriveBIsLaidInItsCradleOnce) {
  ArmCalibrator calibrator(firmware::Drive::Motor, 6);
  const auto at_rest =
      static_cast<std::int32_t>(std::lround(cradle_angle_rad() / kRadPerMotorCount));
  Samples samples(kSamplesOfStep, {at_rest + 100, at_rest - 5, at_rest + 3 * kCountsOfTurn + 9});
  ASSERT_EQ(calibrator.take(samples), std::nullopt);
  const auto made = calibrator.finish("now");
  ASSERT_TRUE(made.has_value());
  EXPECT_EQ(made->zero_in_turn, (std::array<std::int32_t, 3>{100, kCountsOfTurn - 5, 9}));
}

TEST(ArmCalibrator, WhatWasKnownOfTheServosStays) {
  ArmCalibration known = fake_calibration(firmware::Drive::Stop, 5);
  known.servos[1].gap_rad = 0.2;
  Sensors sensors;
  ArmCalibrator calibrator(firmware::Drive::Stop, 5, known);
  for (std::size_t step = 0; step < 18; ++step) {
    ASSERT_EQ(calibrator.take(sensors.hold(step / 6, radians_from_degrees(kGaugeDeg[step % 6]))),
              std::nullopt);
  }
  EXPECT_EQ(calibrator.finish("now")->servos[1].gap_rad, 0.2);
}

}  // namespace
}  // namespace carpus::devices
