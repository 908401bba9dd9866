// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/portal_tool.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "arm/delta_arm.hpp"
#include "core/rng.hpp"

namespace carpus::arm {
namespace {

Vec3 some_handle(Rng& rng) {
  return DeltaArm{}.centre + Vec3{rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-40, 40)};
}

TEST(PortalTool, HangsStraightInTheMiddleOfTheArm) {
  const auto state = portal_state(PortalTool{}, DeltaArm{}.centre);
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->depth_mm, 25, 1e-12);
  EXPECT_NEAR(state->outside_mm, 100, 1e-12);
  EXPECT_LT(distance(state->tip, {0, 0, -255}), 1e-12);
  EXPECT_EQ(state->pitch_rad, 0);
  EXPECT_EQ(state->yaw_rad, 0);
}

TEST(PortalTool, HandleUndoesTipWhereverTheTipIsInside) {
  const PortalTool tool;
  Rng rng(3);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 handle = some_handle(rng);
    const auto state = portal_state(tool, handle);
    ASSERT_TRUE(state);
    EXPECT_NEAR(distance(state->tip, handle), tool.length_mm, 1e-9);
    if (state->depth_mm < 1) continue;
    ++inside;
    EXPECT_NEAR(distance(state->tip, tool.portal), state->depth_mm, 1e-9);
    const auto back = handle_at(tool, state->tip);
    ASSERT_TRUE(back);
    EXPECT_LT(distance(*back, handle), 1e-8);
  }
  EXPECT_GT(inside, 1000);
}

TEST(PortalTool, VelocityIsTheTipsOwn) {
  const PortalTool tool;
  Rng rng(4);
  for (int i = 0; i < 500; ++i) {
    const Vec3 handle = some_handle(rng);
    const Vec3 step = Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * 1e-5;
    const auto before = portal_state(tool, handle - step);
    const auto after = portal_state(tool, handle + step);
    const Vec3 moved = after->tip - before->tip;
    const Vec3 said = through_portal(*portal_state(tool, handle), step * 2);
    EXPECT_LT(distance(moved, said), 1e-10);
  }
}

TEST(PortalTool, HandAndPortalHoldTheToolTogether) {
  // Forces and moments about the handle: tip, portal, and the hand against what it feels.
  const PortalTool tool;
  Rng rng(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 handle = some_handle(rng);
    const auto state = portal_state(tool, handle);
    const Vec3 at_tip{rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-4, 4)};
    const Vec3 at_portal = portal_force(*state, at_tip);
    EXPECT_NEAR(dot(at_portal, state->along), 0, 1e-12);
    EXPECT_LT(length(at_tip + at_portal - through_portal(*state, at_tip)), 1e-12);
    EXPECT_LT(length(cross(state->tip - handle, at_tip) + cross(tool.portal - handle, at_portal)),
              1e-9);
  }
}

TEST(PortalTool, AWeakArmIsStrongAcrossTheShaft) {
  // 25 mm inside, 100 mm outside: 4 N across is 1 N at the handle, the other way; 4 N along is 4 N.
  const auto state = portal_state(PortalTool{}, DeltaArm{}.centre);
  EXPECT_LT(distance(through_portal(*state, {4, 0, 0}), {-1, 0, 0}), 1e-12);
  EXPECT_LT(distance(through_portal(*state, {0, 0, 4}), {0, 0, 4}), 1e-12);
}

TEST(PortalTool, LiesAsItsGimbalTurnsIt) {
  const PortalTool tool;
  Rng rng(6);
  for (int i = 0; i < 200; ++i) {
    const auto state = portal_state(tool, some_handle(rng));
    const Mat3 rotation = tool_rotation(*state, rng.uniform(-3, 3));
    EXPECT_LT(distance(rotation * Vec3{0, 0, -1}, state->along), 1e-12);
    EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
    // The inner axis, before the roll, stays across the outer one, which is the platform's.
    EXPECT_NEAR((tool_rotation(*state, 0) * Vec3{1, 0, 0}).y, 0, 1e-12);
  }
}

TEST(PortalTool, RefusesWhatHasNoAnswer) {
  const PortalTool tool;
  EXPECT_FALSE(portal_state(tool, tool.portal));
  EXPECT_FALSE(portal_state(tool, tool.portal + Vec3{0, 0, 10}));
  EXPECT_FALSE(portal_state(tool, tool.portal - Vec3{0, 0, 60}));
  EXPECT_FALSE(portal_state(tool, {std::nan(""), 0, -130}));
  EXPECT_FALSE(handle_at(tool, tool.portal));
  EXPECT_FALSE(handle_at(tool, tool.portal - Vec3{0, 0, 120}));
}

}  // namespace
}  // namespace carpus::arm
