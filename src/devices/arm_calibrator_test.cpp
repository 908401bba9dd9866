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
  /// All three legs at an edge of their slots, servos of so many degrees in 0.9 to 2.1 ms.
  [[nodiscard]] Samples push(const ArmCalibrator& calibrator, double travel_deg, double gap_deg) {
    const double horn =
        radians_from_degrees(10.17 + (calibrator.pulse_us() - 1500) * travel_deg / 1200);
    const bool is_back = calibrator.step() >= 18 + kSweepUs.size();
    const double angle = horn + radians_from_degrees(is_back ? gap_deg : -gap_deg);
    Samples samples(kSamplesOfStep);
    for (auto& sample : samples) {
      for (std::size_t leg = 0; leg < kLegs; ++leg) sample[leg] = read(leg, angle);
    }
    return samples;
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

/// The servos' part, to its end.
void sweep(ArmCalibrator& calibrator,
           Sensors& sensors,
           double travel_deg = 162,
           double gap_deg = 9) {
  EXPECT_NE(calibrator.instruction().find("gently up"), std::string::npos);
  while (!calibrator.is_complete()) {
    const std::size_t at = (calibrator.step() - 18) % kSweepUs.size();
    EXPECT_EQ(calibrator.is_by_itself(), at != 0) << "a person takes hold first";
    ASSERT_GT(calibrator.pulse_us(), 0);
    ASSERT_EQ(calibrator.take(sensors.push(calibrator, travel_deg, gap_deg)), std::nullopt);
  }
}

void visit_notches(ArmCalibrator& calibrator, Sensors& sensors) {
  for (std::size_t step = 0; step < 18; ++step) {
    EXPECT_EQ(calibrator.pulse_us(), 0);
    ASSERT_EQ(calibrator.take(sensors.hold(step / 6, radians_from_degrees(kGaugeDeg[step % 6]))),
              std::nullopt);
  }
}

TEST(ArmCalibrator, DriveAIsGuidedThroughAllNotchesToSixTenthsOfADegree) {
  Sensors sensors;
  ArmCalibrator calibrator(firmware::Drive::Stop, 5);
  EXPECT_EQ(calibrator.step_count(), 30U);
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    for (const double notch : kGaugeDeg) {
      const std::string asked = calibrator.instruction();
      EXPECT_NE(asked.find("Leg " + std::to_string(leg + 1)), std::string::npos);
      const std::string side = notch < 0 ? "up" : notch > 0 ? "down" : "level";
      EXPECT_NE(asked.find(side), std::string::npos) << asked;
      if (notch != 0) {
        const std::string angle = std::to_string(static_cast<int>(std::abs(notch))) + " degrees ";
        EXPECT_NE(asked.find(angle + side), std::string::npos) << asked;
      }
      const double angle = radians_from_degrees(notch);
      // A hand that trembles is told, and the step stays.
      const auto problem = calibrator.take(sensors.hold(leg, angle, 0.05));
      ASSERT_TRUE(problem.has_value());
      EXPECT_NE(problem->find("keep it still"), std::string::npos);
      EXPECT_EQ(calibrator.take(sensors.hold(leg, angle)), std::nullopt);
    }
  }
  sweep(calibrator, sensors);
  ASSERT_TRUE(calibrator.is_complete());
  const auto made = calibrator.finish("now");
  ASSERT_TRUE(made.has_value()) << made.error();
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

TEST(ArmCalibrator, NotchesMixedUpAreToldAtOnceAndThatLegsBeginAnew) {
  Sensors sensors;
  ArmCalibrator calibrator(firmware::Drive::Stop, 5);
  const auto hold = [&](std::size_t leg, std::size_t notch) {
    return calibrator.take(sensors.hold(leg, radians_from_degrees(kGaugeDeg[notch])));
  };
  for (std::size_t notch = 0; notch < 6; ++notch) ASSERT_EQ(hold(0, notch), std::nullopt);
  for (const std::size_t notch : {0, 1, 3, 2, 4}) ASSERT_EQ(hold(1, notch), std::nullopt);
  const auto problem = hold(1, 5);
  ASSERT_TRUE(problem.has_value());
  EXPECT_NE(problem->find("Leg 2"), std::string::npos);
  EXPECT_EQ(calibrator.step(), 6U);  // of leg 1 nothing is lost
  for (std::size_t notch = 0; notch < 6; ++notch) ASSERT_EQ(hold(1, notch), std::nullopt);
  for (std::size_t notch = 0; notch < 6; ++notch) ASSERT_EQ(hold(2, notch), std::nullopt);
  sweep(calibrator, sensors);
  EXPECT_TRUE(calibrator.finish("now").has_value());
}

TEST(ArmCalibrator, MeasuresHowEachServoSits) {
  Sensors sensors;
  ArmCalibrator calibrator(firmware::Drive::Stop, 5);
  visit_notches(calibrator, sensors);
  sweep(calibrator, sensors, 170, 9.3);
  const auto made = calibrator.finish("now");
  ASSERT_TRUE(made.has_value()) << made.error();
  for (const ServoFit& fit : made->servos) {
    const double us_per_deg = 1200.0 / 170;
    EXPECT_NEAR(fit.pulse_per_half_turn_us, 180 * us_per_deg, 40);
    EXPECT_NEAR(fit.pulse_at_zero_us, 1500 - 10.17 * us_per_deg, 5);
    EXPECT_NEAR(degrees_from_radians(fit.gap_rad), 9.3, 0.3);
    EXPECT_GE(fit.least_pulse_us, 900);
    EXPECT_LE(fit.most_pulse_us, 2100);
  }
}

TEST(ArmCalibrator, AServoThatTurnsTooLittleOrNotAtAllIsTold) {
  const auto told = [](double travel_deg, double gap_deg) {
    Sensors sensors;
    ArmCalibrator calibrator(firmware::Drive::Stop, 5);
    visit_notches(calibrator, sensors);
    sweep(calibrator, sensors, travel_deg, gap_deg);
    const auto made = calibrator.finish("now");
    EXPECT_FALSE(made.has_value());
    EXPECT_EQ(calibrator.step(), 18U) << "the notches stay";
    return made ? std::string() : made.error();
  };
  EXPECT_NE(told(108, 9).find("270 degrees"), std::string::npos);  // 90 degrees a millisecond
  EXPECT_NE(told(0, 0).find("does not turn"), std::string::npos);
  EXPECT_NE(told(162, 1).find("slot measured 1 deg"), std::string::npos);
}

TEST(ArmCalibrator, DriveBIsLaidInItsCradleOnce) {
  ArmCalibrator calibrator(firmware::Drive::Motor, 6);
  EXPECT_FALSE(calibrator.is_whole());
  const auto at_rest =
      static_cast<std::int32_t>(std::lround(cradle_angle_rad() / kRadPerMotorCount));
  Samples samples(kSamplesOfStep, {at_rest + 100, at_rest - 5, at_rest + 3 * kCountsOfTurn + 9});
  ASSERT_EQ(calibrator.take(samples), std::nullopt);
  EXPECT_FALSE(calibrator.is_whole()) << "how its windings stand is not known";
  EXPECT_GT(calibrator.pulse_us(), 0);
  MotorWindings windings;
  EXPECT_NE(calibrator.take({}, windings)->find("not done"), std::string::npos);
  windings.progress = static_cast<std::uint8_t>(firmware::Progress::Refused);
  EXPECT_NE(calibrator.take({}, windings)->find("did not follow"), std::string::npos);
  windings = {static_cast<std::uint8_t>(firmware::Progress::Found), {7, 8, 9}, {1, 2, 1}};
  EXPECT_FALSE(calibrator.is_enough(0, {}));
  EXPECT_TRUE(calibrator.is_enough(0, windings));
  ASSERT_EQ(calibrator.take({}, windings), std::nullopt);
  EXPECT_EQ(calibrator.pulse_us(), 0);
  EXPECT_TRUE(calibrator.is_whole());
  EXPECT_FALSE(calibrator.is_complete());
  EXPECT_TRUE(calibrator.finish("now").has_value());
  EXPECT_EQ(calibrator.sample_count(), kSamplesOfLead);
  samples.resize(kSamplesOfLead, samples.front());
  const auto problem = calibrator.take(samples);  // still in its cradle
  ASSERT_TRUE(problem.has_value());
  EXPECT_NE(problem->find("moved too little"), std::string::npos);
  Rng rng(4);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      const double turn = 0.006283 * static_cast<double>(i) + 2.0 * static_cast<double>(leg);
      const auto noise = static_cast<std::int32_t>(rng.below(2));
      samples[i][leg] = static_cast<std::int32_t>(3000 * std::sin(turn)) + noise;
    }
  }
  ASSERT_EQ(calibrator.take(samples), std::nullopt);
  const auto made = calibrator.finish("now");
  ASSERT_TRUE(made.has_value());
  EXPECT_EQ(made->windings[1].electrical_zero, 8);
  EXPECT_EQ(made->windings[1].windings, firmware::Windings::Against);
  EXPECT_EQ(made->zero_in_turn, (std::array<std::int32_t, 3>{100, kCountsOfTurn - 5, 9}));
}

}  // namespace
}  // namespace carpus::devices
