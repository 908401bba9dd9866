// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scope that is led on through the joint comes against the capsule across from its portal.
#include <gtest/gtest.h>

#include "simulation/box_joint_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

procedure::Procedure with_scope() {
  procedure::Procedure made = probing(false);
  made.tray = {*instruments::instrument_of("arthroscope_1_9_30")};
  return made;
}

std::uint32_t pushes(const World& world) { return world.operation_record().scope->capsule_pushes; }

/// The wish goes so far beyond the far wall, and stays.
void push(Hand& hand, double beyond_mm) { hand.go(kMiddle - Vec3{kHalf + beyond_mm, 0, 0}, 200); }

TEST(CapsulePush, IsCountedOnceUntilTheScopeLetsUp) {
  const procedure::Procedure scoping = with_scope();
  World world(box_wrist(), scoping, 1);
  Hand hand(world);
  enter(hand);
  EXPECT_EQ(pushes(world), 0U) << "in the middle";
  push(hand, 0.8);
  EXPECT_EQ(pushes(world), 0U) << "lightly";
  push(hand, 4);
  EXPECT_EQ(pushes(world), 1U);
  push(hand, 5);
  EXPECT_EQ(pushes(world), 1U) << "it is one push all the time";
  hand.go(kMiddle, 100);
  push(hand, 4);
  EXPECT_EQ(pushes(world), 2U);
}

TEST(CapsulePush, OnAWallBesideTheWayInIsNone) {
  const procedure::Procedure scoping = with_scope();
  World world(box_wrist(), scoping, 1);
  Hand hand(world);
  enter(hand);
  hand.go(kMiddle + Vec3{0, 0, kHalfHigh + 5}, 200);
  ASSERT_GT(world.operation_record().scope->warn_ticks, 0U);
  EXPECT_EQ(pushes(world), 0U);
}

TEST(CapsulePush, OfAProbeIsNone) {
  World world(box_wrist(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  push(hand, 5);
  ASSERT_GT(world.operation_record().scope->warn_ticks, 0U);
  EXPECT_EQ(pushes(world), 0U);
}

TEST(CapsulePush, AKeyframeGoesOnWithIt) {
  const procedure::Procedure scoping = with_scope();
  World world(box_wrist(), scoping, 1);
  Hand hand(world);
  enter(hand);
  push(hand, 4);
  World later(box_wrist(), scoping, 1);
  ASSERT_TRUE(later.read_state(world.write_state()).has_value());
  for (int i = 0; i < 100; ++i) later.step(hand.inputs.back());
  EXPECT_EQ(pushes(later), 1U);
}

}  // namespace
}  // namespace carpus::simulation
