// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/c_arm_angles.hpp"

#include <gtest/gtest.h>

namespace carpus::simulation {
namespace {

TEST(CArmAngles, PronationUnderASourceThatKeepsStillLeadsFromLateralToPa) {
  EXPECT_DOUBLE_EQ(held_rotation_deg(90, radians_from_degrees(0)), 90);
  EXPECT_DOUBLE_EQ(held_rotation_deg(90, radians_from_degrees(45)), 45);
  EXPECT_DOUBLE_EQ(held_rotation_deg(90, radians_from_degrees(90)), 0);
}

TEST(CArmAngles, RoomAndForearmAreEachOthersReverse) {
  for (double rotation = -175; rotation <= 180; rotation += 5) {
    for (const double pronation : {-1.5, -0.3, 0.0, 0.7, 1.5}) {
      const double there = room_rotation_deg(rotation, pronation);
      EXPECT_GT(there, -180.0 - 1e-9);
      EXPECT_LE(there, 180.0);
      EXPECT_NEAR(held_rotation_deg(there, pronation), rotation, 1e-9);
    }
  }
}

}  // namespace
}  // namespace carpus::simulation
