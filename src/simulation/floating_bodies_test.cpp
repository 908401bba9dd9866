// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/box_joint_test_support.hpp"
#include "simulation/detail/loose_bodies.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

constexpr double kRadiusMm = 1.0;
constexpr double kMouthMm = 0.8;

const procedure::Procedure& removing() {
  static const procedure::Procedure kProcedure = [] {
    procedure::Procedure made = probe_alone();
    made.tray = {*instruments::instrument_of("grasper_2_0")};
    made.removal.emplace();
    made.removal->bodies = {1, 1};
    made.removal->radius_mm = {kRadiusMm, kRadiusMm};
    made.removal->places = {16};
    return made;
  }();
  return kProcedure;
}

Vec3 body(const Hand& hand) { return hand.now().scope.loose[0].at_in_patient; }
const procedure::LooseFacts& facts(const Hand& hand) { return hand.now().scope.facts.loose; }

/// Brings the open jaws over it; where it lies is where it was left.
void go_over(Hand& hand) {
  hand.drive(Driver::Reverse);
  enter(hand);
  for (int turn = 0; turn < 3; ++turn) {
    hand.go(body(hand) - hand.now().items[0].shaft_in_patient * kMouthMm, 50);
  }
}

void draw_out(Hand& hand, double mm_per_tick) {
  hand.mm_per_tick = mm_per_tick;
  hand.go(kMiddle);
  hand.go(kMiddle + Vec3{40, 0, 0});
}

TEST(FloatingBodies, LieByTheirBoneUntilSomethingComesInThenSinkAndRest) {
  World world(box_wrist(), removing(), 1);
  Hand hand(world);
  hand.step();
  ASSERT_EQ(hand.now().scope.loose_count, 1);
  const Vec3 first = body(hand);
  EXPECT_NEAR(first.z, -kHalfHigh + 0.9 * kRadiusMm, 0.2) << "on the floor";
  enter(hand);
  hand.go(kMiddle, 500);
  const Vec3 rests = body(hand);
  EXPECT_LT(distance(rests, first), 1.0);
  hand.go(kMiddle, 200);
  EXPECT_EQ(body(hand), rests) << "to the bit";
}

TEST(FloatingBodies, WhatIsCaughtComesOutSlowlyAndIsStrippedOffByHaste) {
  World world(box_wrist(), removing(), 1);
  Hand hand(world);
  go_over(hand);
  hand.drive(Driver::Forward);
  ASSERT_EQ(facts(hand).catches, 1U);
  EXPECT_EQ(hand.now().scope.loose[0].hand, 0);
  draw_out(hand, 0.03);
  EXPECT_EQ(facts(hand).out, 0) << "at 30 mm/s";
  EXPECT_EQ(facts(hand).slips, 1U);
  EXPECT_EQ(hand.now().scope.loose_count, 1) << "it lies in the joint again";
  hand.mm_per_tick = 0.02;
  go_over(hand);
  hand.drive(Driver::Forward);
  ASSERT_EQ(facts(hand).catches, 2U);
  draw_out(hand, 0.006);
  EXPECT_EQ(facts(hand).out, 1);
  EXPECT_EQ(facts(hand).slips, 1U);
  EXPECT_EQ(hand.now().scope.loose_count, 0);
}

TEST(FloatingBodies, JawsLockUntilTheyAreOpened) {
  World world(box_wrist(), removing(), 1);
  Hand hand(world);
  go_over(hand);
  hand.drive(Driver::Forward);
  hand.drive(Driver::Off);
  hand.go(kMiddle, 100);
  EXPECT_EQ(hand.now().scope.loose[0].hand, 0) << "a hand that is not heard of loses nothing";
  hand.drive(Driver::Reverse);
  EXPECT_GT(hand.now().scope.loose[0].hand, 1);
  const double high = body(hand).z;
  hand.go(kMiddle, 300);
  EXPECT_LT(body(hand).z, high - 0.5) << "it sinks";
}

TEST(FloatingBodies, WhatIsLetGoInTheWayOutSlipsBackIntoTheJoint) {
  for (const bool opens : {true, false}) {
    World world(box_wrist(), removing(), 1);
    Hand hand(world);
    go_over(hand);
    hand.drive(Driver::Forward);
    hand.mm_per_tick = 0.006;
    hand.go(kMiddle);
    hand.go(kMiddle + Vec3{kHalf + 4, 0, 0});
    ASSERT_FALSE(hand.now().scope.facts.is_in_joint[0]);
    ASSERT_EQ(hand.now().scope.loose[0].hand, 0);
    if (opens) {
      hand.drive(Driver::Reverse);
    } else {
      Command put_down;
      put_down.kind = CommandKind::PutDown;
      hand.command(put_down);
    }
    for (int i = 0; i < 500; ++i) hand.step();
    ASSERT_EQ(hand.now().scope.loose_count, 1);
    EXPECT_GT(hand.now().scope.loose[0].hand, 1);
    EXPECT_LT(body(hand).x, kMiddle.x + kHalf) << (opens ? "opened" : "put down");
    EXPECT_EQ(facts(hand).out, 0);
  }
}

TEST(FloatingBodies, JawsThatCloseOnTheWallBiteAndUnseenOnesAreCounted) {
  World world(box_wrist(), removing(), 1);
  Hand hand(world);
  hand.drive(Driver::Reverse);
  enter(hand);
  hand.drive(Driver::Forward);
  EXPECT_EQ(facts(hand).bites, 0U) << "in the middle of the joint";
  EXPECT_EQ(facts(hand).unseen_closings, 1U) << "no scope is in";
  hand.drive(Driver::Reverse);
  hand.go(kMiddle + Vec3{-6, -8, -kHalfHigh + 0.2}, 50);
  hand.drive(Driver::Forward);
  EXPECT_EQ(facts(hand).bites, 1U);
  EXPECT_EQ(facts(hand).closings, 2U);
  EXPECT_EQ(facts(hand).catches, 0U);
}

TEST(FloatingBodies, GoOnFromAKeyframeToTheSameBits) {
  World world(box_wrist(), removing(), 1);
  Hand hand(world);
  go_over(hand);
  hand.drive(Driver::Forward);
  World again(box_wrist(), removing(), 1);
  ASSERT_TRUE(again.read_state(world.write_state()).has_value());
  Input back = hand.inputs.back();
  for (int i = 0; i < 500; ++i) {
    back.hands[0].tip_in_patient += Vec3{0.006, 0, 0};
    world.step(back);
    again.step(back);
  }
  EXPECT_EQ(again.now().state_hash, world.now().state_hash);
  EXPECT_EQ(again.now().scope.loose[0], world.now().scope.loose[0]);
}

TEST(Drift, TakesUpTheFlowAndSinksWithItsOwnSpeed) {
  detail::LooseBody falls;
  detail::LooseSurroundings around;
  around.down = {0, 0, -1};
  for (int i = 0; i < 300; ++i) detail::drift(falls, kRadiusMm, around);
  EXPECT_NEAR(falls.velocity.z, -30, 0.1);
  around.flow = {5, 0, 0};
  for (int i = 0; i < 300; ++i) detail::drift(falls, kRadiusMm, around);
  EXPECT_NEAR(falls.velocity.x, 5, 0.1);
}

TEST(Drift, FrictionHoldsItOnASlopeThatIsNotSteep) {
  for (const double slope : {0.3, 0.8}) {
    detail::LooseBody lies;
    detail::LooseSurroundings around;
    around.down = {0, 0, -1};
    around.has_wall = true;
    around.outwards = normalized_or(Vec3{slope, 0, -1}, {0, 0, -1});
    for (int i = 0; i < 500; ++i) {
      around.wall_mm = dot(lies.at, around.outwards) - 0.9 * kRadiusMm;
      detail::drift(lies, kRadiusMm, around);
    }
    EXPECT_EQ(lies.at.x<-0.5, slope> 0.5) << slope;
  }
}

TEST(Drift, ARodPushesItAsideAndTheInflowFadesWithDistance) {
  detail::LooseBody lies;
  lies.at = {1.2, 0, 0};
  for (int i = 0; i < 200; ++i) {
    detail::push_aside(lies, kRadiusMm, {0, 0, -20}, {0, 0, 20}, 0.5);
  }
  EXPECT_NEAR(lies.at.x, 1.5, 1e-6);
  const double near = length(detail::inflow_at({}, {0, 0, 1}, {0, 0, -2}));
  const double far = length(detail::inflow_at({}, {0, 0, 1}, {0, 0, -10}));
  EXPECT_GT(near, 4 * far);
  EXPECT_EQ(length(detail::inflow_at({}, {0, 0, 1}, {0, 0, 5})), 0) << "behind it";
}

TEST(LooseState, OneThatNoTickLeftIsRefused) {
  detail::LooseState state;
  state.done.there = 2;
  EXPECT_TRUE(detail::is_possible(state, 2, 3));
  EXPECT_FALSE(detail::is_possible(state, 1, 3));
  state.done.out = 1;
  EXPECT_FALSE(detail::is_possible(state, 2, 3)) << "which one?";
  state.bodies[1].is_out = true;
  EXPECT_TRUE(detail::is_possible(state, 2, 3));
  state.bodies[0].portal = 3;
  EXPECT_FALSE(detail::is_possible(state, 2, 3)) << "there is no such portal";
  state.bodies[0].portal = 2;
  state.bodies[0].hand = 7;
  EXPECT_FALSE(detail::is_possible(state, 2, 3));
}

}  // namespace
}  // namespace carpus::simulation
