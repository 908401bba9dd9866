// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/cogging.hpp"

#include <gtest/gtest.h>

#include "core/units.hpp"

namespace carpus::arm {
namespace {

TEST(Cogging, TheForceAgainstItIsItsTorquesTurnedRound) {
  const DeltaArm arm;
  const Cogging cogging{{15, 12, 9}, {0.3, 1, 2}};
  const LegAngles angles{0.31, 0.22, 0.4};
  const Vec3 force = against_cogging(arm, cogging, angles, {}, 0.003);
  const auto state = firmware::delta_forward(arm.size, angles.data());
  double torques[3];
  firmware::delta_torques(state, {force.x, force.y, force.z}, torques);
  const LegAngles own = cogging_torques(cogging, angles);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(torques[i], -own[i], 1e-9);
}

TEST(Cogging, IsLeftAloneWhereTheLegsAreTooFastForTheHost) {
  const Cogging cogging{{15, 15, 15}, {0, 0, 0}};
  const double fast = 170 * 2 * kPi / 840;
  EXPECT_EQ(against_cogging({}, cogging, {0.3, 0.3, 0.3}, {fast, -fast, fast}, 0.003), Vec3{});
}

}  // namespace
}  // namespace carpus::arm
