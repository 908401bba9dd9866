// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/numbers.hpp"

#include <gtest/gtest.h>

#include "arm/delta_arm.hpp"
#include "arm/portal_tool.hpp"
#include "core/units.hpp"
#include "devices/arm_calibrator.hpp"
#include "firmware/core/motor_arm.hpp"

namespace carpus::hardware {
namespace {

const Numbers& numbers() {
  static const Numbers kept("hardware/parts/numbers.scad");
  return kept;
}

TEST(HardwareNumbers, AreTheProgramsOwn) {
  const arm::DeltaArm arm;
  EXPECT_EQ(numbers()["upper_arm"], arm.size.upper_arm);
  EXPECT_EQ(numbers()["rod"], arm.size.rod);
  EXPECT_EQ(numbers()["offset"], arm.size.offset);
  EXPECT_EQ(numbers()["centre_z"], arm.centre.z);
  // The program rounds the limits to thousandths of a radian.
  EXPECT_NEAR(numbers()["least_angle"], degrees_from_radians(arm.least_angle), 0.06);
  EXPECT_NEAR(numbers()["most_angle"], degrees_from_radians(arm.most_angle), 0.06);
  const arm::PortalTool tool;
  EXPECT_EQ(numbers()["tool_length"], tool.length_mm);
  EXPECT_EQ(numbers()["portal_z"], tool.portal.z);
  EXPECT_EQ(tool.portal.x, 0);
  EXPECT_EQ(tool.portal.y, 0);
}

TEST(HardwareNumbers, GearTheEncoderAsTheFirmwareHasIt) {
  EXPECT_NEAR(numbers()["capstan_ratio"], 2 * kPi / (16384.0 * firmware::kRadPerCount), 1e-4);
}

TEST(HardwareNumbers, CutTheNotchesThatCalibrationAsksFor) {
  for (std::size_t i = 0; i < devices::kGaugeDeg.size(); ++i) {
    EXPECT_EQ(devices::kGaugeDeg[i],
              numbers()["gauge_first"] + static_cast<double>(i) * numbers()["gauge_step"]);
  }
  EXPECT_EQ(devices::kGaugeDeg.back(), numbers()["gauge_last"]);
}

TEST(HardwareNumbers, WidenTheSlotAsHostAndVirtualArmBelieve) {
  const double gap = radians_from_degrees(numbers()["slot_gap"]);
  EXPECT_NEAR(devices::ServoFit{}.gap_rad, gap, 1e-3);
}

TEST(HardwareNumbers, LeaveRoomForTheLegsToTurn) {
  // The fork's servo turns 180 degrees: the leg's way and the slot to either side fit in.
  EXPECT_LT(numbers()["most_angle"] - numbers()["least_angle"] + 2 * numbers()["slot_gap"], 180);
}

}  // namespace
}  // namespace carpus::hardware
