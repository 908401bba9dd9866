// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/arm_weight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace carpus::arm {
namespace {

constexpr double kGravity = 9.80665e-3;

Vec3 some_place(const DeltaArm& arm, Rng& rng) {
  return arm.centre + Vec3{rng.uniform(-45, 45), rng.uniform(-45, 45), rng.uniform(-35, 35)};
}

TEST(ArmWeight, IsTheChangeOfThePotentialEnergyWithEachAngle) {
  const DeltaArm arm;
  const ArmWeight weight{60, 25, 45, 12, 0};
  const auto energy = [&](const LegAngles& angles) {
    double sum = weight.tip_g * forward(arm, angles)->z;
    for (const double angle : angles) {
      sum +=
          weight.leg_g * (-weight.along_mm * std::sin(angle) + weight.above_mm * std::cos(angle));
    }
    return sum * kGravity;
  };
  Rng rng(8);
  for (int i = 0; i < 200; ++i) {
    const LegAngles angles = *inverse(arm, some_place(arm, rng));
    const LegAngles torques = gravity_torques(arm, angles, weight);
    for (std::size_t leg = 0; leg < 3; ++leg) {
      LegAngles more = angles;
      LegAngles less = angles;
      more[leg] += 1e-5;
      less[leg] -= 1e-5;
      EXPECT_NEAR(torques[leg], (energy(more) - energy(less)) / 2e-5,
                  1e-5 * (1 + std::abs(torques[leg])));
    }
  }
}

TEST(ArmWeight, ACordGivesTheChangeOfItsOwnEnergy) {
  const LegCord cord;
  const auto energy = [&](double angle) {
    const double length = std::hypot(cord.pin_mm * std::cos(angle) - cord.mast_x_mm,
                                     -cord.pin_mm * std::sin(angle) - cord.mast_z_mm);
    const double open = std::max(0.0, length - cord.slack_mm);
    return cord.tension_n * open + cord.rate_n_per_mm * open * open / 2;
  };
  for (double angle = -1; angle < 1.36; angle += 0.05) {
    EXPECT_NEAR(cord_torque(cord, angle), -(energy(angle + 1e-5) - energy(angle - 1e-5)) / 2e-5,
                1e-5);
  }
  LegCord slack = cord;
  slack.slack_mm = 200;
  EXPECT_EQ(cord_torque(slack, 0.3), 0);
}

TEST(ArmWeight, TorquesComeToTheForceThatNeedsThem) {
  const DeltaArm arm;
  Rng rng(9);
  for (int i = 0; i < 50; ++i) {
    const LegAngles angles = *inverse(arm, some_place(arm, rng));
    const Vec3 force{rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)};
    LegAngles torques{};
    const auto state = firmware::delta_forward(arm.size, angles.data());
    firmware::delta_torques(state, {force.x, force.y, force.z}, torques.data());
    EXPECT_LT(length(force_at_tip(arm, angles, torques) - force), 1e-9);
  }
  EXPECT_EQ(force_at_tip(arm, {9, 9, 9}, {1, 1, 1}), Vec3{});
}

}  // namespace
}  // namespace carpus::arm
