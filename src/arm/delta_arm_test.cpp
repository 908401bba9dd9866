// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/delta_arm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace carpus::arm {
namespace {

/// Every place of the workspace that is promised, 100 x 100 x 80 mm, 9 x 9 x 9.
template <typename Visit>
void each_place(const DeltaArm& arm, Visit visit) {
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      for (int z = -4; z <= 4; ++z) visit(arm.centre + Vec3{12.5 * x, 12.5 * y, 10.0 * z});
    }
  }
}

TEST(DeltaArm, ForwardUndoesInverseInTheWholeWorkspace) {
  const DeltaArm arm;
  each_place(arm, [&](const Vec3& tip) {
    ASSERT_TRUE(is_in_workspace(arm, tip)) << tip.x << " " << tip.y << " " << tip.z;
    const auto back = forward(arm, *inverse(arm, tip));
    ASSERT_TRUE(back);
    EXPECT_LT(distance(*back, tip), 1e-9);
  });
}

TEST(DeltaArm, NeedsTheTorquesThatWereComputedElsewhere) {
  // 3 N along x, y, z at the centre: (-182, 91, 91), (0, -158, 158), (-105, -105, -105) N mm.
  const DeltaArm arm;
  const auto state = firmware::delta_forward(arm.size, inverse(arm, arm.centre)->data());
  const double wanted[3][3] = {{-182, 91, 91}, {0, -158, 158}, {-105, -105, -105}};
  for (int axis = 0; axis < 3; ++axis) {
    double torques[3];
    firmware::delta_torques(
        state, {axis == 0 ? 3.0 : 0.0, axis == 1 ? 3.0 : 0.0, axis == 2 ? 3.0 : 0.0}, torques);
    for (int leg = 0; leg < 3; ++leg) EXPECT_NEAR(torques[leg], wanted[axis][leg], 0.6);
  }
}

TEST(DeltaArm, HasTenNewtonsForANewtonMetreInItsWorstCorner) {
  const DeltaArm arm;
  double weakest = 1e9;
  double worst = 0;
  double sum = 0;
  int count = 0;
  each_place(arm, [&](const Vec3& tip) {
    const auto strength = strength_at(arm, tip);
    ASSERT_TRUE(strength);
    weakest = std::min(weakest, strength->weakest_n_per_nm);
    worst = std::max(worst, strength->condition);
    sum += strength->condition;
    ++count;
  });
  EXPECT_NEAR(weakest, 10.2, 0.2);
  EXPECT_NEAR(worst, 2.3, 0.1);
  EXPECT_NEAR(sum / count, 1.6, 0.1);
}

TEST(DeltaArm, WhatIsOutOfReachIsSaidToBe) {
  const DeltaArm arm;
  EXPECT_FALSE(inverse(arm, {0, 0, -400}));
  EXPECT_FALSE(inverse(arm, {300, 0, -130}));
  EXPECT_FALSE(is_in_workspace(arm, {0, 0, 0}));
  EXPECT_FALSE(strength_at(arm, {0, 0, -236}));
  EXPECT_FALSE(inverse(arm, {std::nan(""), 0, -130}));
}

}  // namespace
}  // namespace carpus::arm
