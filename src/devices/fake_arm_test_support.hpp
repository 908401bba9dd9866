// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The firmware's core behind a fake line, its legs held at angles that the test says: what a driver
// meets, without a plant.
#pragma once

#include <cmath>
#include <cstdint>

#include "arm/delta_arm.hpp"
#include "devices/arm_calibration.hpp"
#include "devices/device.hpp"
#include "devices/fake_link_test_support.hpp"
#include "firmware/core/motor_arm.hpp"
#include "firmware/core/stop_arm.hpp"

namespace carpus::devices {

/// A leg's line: 2046 counts at angle 0, 340 degrees over 4092 counts.
inline constexpr double kFakeRadPerCount = 5.934 / 4092;

inline ArmCalibration fake_calibration(firmware::Drive drive, std::uint32_t unit) {
  ArmCalibration calibration;
  calibration.drive = drive;
  calibration.unit = unit;
  for (std::size_t i = 0; i < kLegs; ++i) {
    calibration.legs[i].zero_counts = 2046;
    calibration.legs[i].rad_per_count = kFakeRadPerCount;
    calibration.windings[i].windings = firmware::Windings::Along;
    calibration.zero_in_turn[i] = static_cast<std::int32_t>(1000 * (i + 1));
  }
  calibration.made_at = "2026-01-01T00:00:00Z";
  return calibration;
}

/// Drive A.
class FakeStopArm {
 public:
  FakeStopArm(std::shared_ptr<FakeLine> line, std::uint32_t unit)
      : line_(std::move(line)), arm(unit) {}

  /// A millisecond: samples, what came, one answer.
  void step(Nanoseconds now) {
    const auto us = static_cast<std::uint32_t>(now / 1000);
    for (std::uint8_t leg = 0; leg < kLegs; ++leg) {
      arm.sample(leg, counts[leg], us);
      arm.step(leg, us);
      if (arm.pulse_half_us(leg) != 0) arm.sent(leg);
    }
    for (const std::uint8_t byte : line_->to_device) {
      arm.take(byte, us);
      answer(us);
    }
    line_->to_device.clear();
  }
  void put(const arm::LegAngles& angles) {
    for (std::size_t i = 0; i < kLegs; ++i) {
      counts[i] = static_cast<std::uint16_t>(std::lround(2046 + angles[i] / kFakeRadPerCount));
    }
  }

 private:
  void answer(std::uint32_t us) {
    std::uint8_t bytes[firmware::kMaxFrameBytes];
    const std::uint8_t count = arm.reply(bytes, us);
    line_->to_host.insert(line_->to_host.end(), bytes, bytes + count);
  }
  std::shared_ptr<FakeLine> line_;

 public:
  firmware::StopArm arm;
  std::array<std::uint16_t, kLegs> counts{2046, 2046, 2046};
};

/// Drive B, its motors turned to where the test says.
class FakeMotorArm {
 public:
  FakeMotorArm(std::shared_ptr<FakeLine> line, std::uint32_t unit)
      : line_(std::move(line)), arm(unit) {}

  void step(Nanoseconds now) {
    const auto us = static_cast<std::uint32_t>(now / 1000);
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
      arm.step(counts.data(), us + 250 * quarter, torques.data());
    }
    for (const std::uint8_t byte : line_->to_device) {
      arm.take(byte, us + 999);
      std::uint8_t bytes[firmware::kMaxFrameBytes];
      const std::uint8_t count = arm.reply(bytes, us + 999);
      line_->to_host.insert(line_->to_host.end(), bytes, bytes + count);
    }
    line_->to_device.clear();
  }
  /// Angles of the legs, with the encoders' zeros of fake_calibration, some turns on.
  void put(const arm::LegAngles& angles) {
    for (std::size_t i = 0; i < kLegs; ++i) {
      counts[i] = static_cast<std::int32_t>(1000 * (i + 1) + 2 * kCountsOfTurn +
                                            std::lround(angles[i] / kRadPerMotorCount));
    }
  }

 private:
  std::shared_ptr<FakeLine> line_;

 public:
  firmware::MotorArm arm;
  std::array<std::int32_t, kLegs> counts{};
  std::array<float, kLegs> torques{};
};

}  // namespace carpus::devices
