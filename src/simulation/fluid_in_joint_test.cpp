// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluid in the tick: through a scope in a box of a joint.
#include <gtest/gtest.h>

#include "simulation/box_joint_test_support.hpp"
#include "simulation/detail/joint_fluid.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)
using procedure::FluidControl;

procedure::Procedure looking(bool has_fluid) {
  procedure::Procedure made = probe_alone();
  made.tray = {*instruments::instrument_of("arthroscope_1_9_30")};
  if (has_fluid) made.fluid.emplace();
  return made;
}

const procedure::Procedure& with_fluid() {
  static const procedure::Procedure kProcedure = looking(true);
  return kProcedure;
}
const procedure::Procedure& without() {
  static const procedure::Procedure kProcedure = looking(false);
  return kProcedure;
}

Command set(FluidControl control, std::uint8_t value) {
  Command command;
  command.kind = CommandKind::SetFluid;
  command.index = fluid_index(control, value);
  return command;
}

TEST(FluidInJoint, RunsInThroughTheScopeAndKeepsItsPressure) {
  World world(box_wrist(), with_fluid(), 1);
  Hand hand(world);
  hand.step();
  EXPECT_EQ(hand.now().scope.fluid.pressure_mmhg, 0.0);
  enter(hand);
  EXPECT_GT(hand.now().scope.fluid.haze_per_mm, 0.0) << "a fresh portal bleeds";
  EXPECT_GT(hand.now().scope.fluid.bubbles, 0.0) << "and air came along";
  hand.go(kMiddle, 20'000);
  EXPECT_NEAR(hand.now().scope.fluid.pressure_mmhg, 26, 2);
  hand.go(kMiddle + Vec3{40, 0, 0}, 25'000);
  EXPECT_LT(hand.now().scope.fluid.pressure_mmhg, 1) << "it runs out by portal and needle";
}

TEST(FluidInJoint, WhatItHidesIsNotSeen) {
  for (const bool is_clear : {true, false}) {
    World world(box_wrist(), with_fluid(), 1);
    Hand hand(world);
    if (!is_clear) {
      hand.step();
      hand.command(set(FluidControl::Inflow, 0));  // nothing stops what bleeds
      hand.command(set(FluidControl::Outflow, 0));
    }
    enter(hand);
    hand.go(kMiddle, 30'000);
    const procedure::OperationRecord record = world.operation_record();
    EXPECT_EQ(record.scope->fluid.clouded_ticks > 0, !is_clear);
    EXPECT_EQ(hand.now().scope.fluid.haze_per_mm > 0.14, !is_clear);
  }
}

TEST(FluidInJoint, ControlsAreRefusedWhereThereIsNoFluidOrNoSuchValue) {
  const auto is_refused = [](const procedure::Procedure& procedure, const Command& command) {
    World world(box_wrist(), procedure, 1);
    Hand hand(world);
    hand.step();
    hand.command(command);
    return hand.now().event_count > 0 && hand.now().events[0].kind == EventKind::Refused;
  };
  EXPECT_TRUE(is_refused(without(), set(FluidControl::Dry, 1)));
  EXPECT_FALSE(is_refused(with_fluid(), set(FluidControl::Dry, 1)));
  EXPECT_FALSE(is_refused(with_fluid(), set(FluidControl::Inflow, 20)));
  EXPECT_TRUE(is_refused(with_fluid(), set(FluidControl::Inflow, 21)));
  EXPECT_TRUE(is_refused(with_fluid(), set(FluidControl::Outflow, 2)));
  EXPECT_TRUE(is_refused(with_fluid(), set(FluidControl::Flush, 1)));
}

TEST(FluidInJoint, TellsTooMuchPressureAndASwollenWristOnce) {
  World world(box_wrist(), with_fluid(), 1);
  Hand hand(world);
  hand.step();
  hand.command(set(FluidControl::Inflow, 20));
  hand.command(set(FluidControl::Outflow, 0));
  enter(hand);
  int too_high = 0;
  int swells = 0;
  for (int i = 0; i < 90'000; ++i) {
    hand.step();
    for (int e = 0; e < hand.now().event_count; ++e) {
      const EventKind kind = hand.now().events[static_cast<std::size_t>(e)].kind;
      if (kind == EventKind::PressureTooHigh) ++too_high;
      if (kind == EventKind::TissueSwells) ++swells;
    }
  }
  EXPECT_LE(too_high, 1);
  EXPECT_EQ(swells, 1);
}

TEST(FluidInJoint, AStateComesBackAndGoesOnToTheSameHashes) {
  World world(box_wrist(), with_fluid(), 1);
  Hand hand(world);
  hand.step();
  hand.command(set(FluidControl::Inflow, 4));
  enter(hand);
  hand.command(set(FluidControl::Flush, 0));
  const std::vector<std::byte> bytes = world.write_state();
  World again(box_wrist(), with_fluid(), 1);
  ASSERT_TRUE(again.read_state(bytes));
  const Snapshot& read = again.now();
  EXPECT_EQ(read.scope.fluid, hand.now().scope.fluid);
  for (int i = 0; i < 3000; ++i) {
    hand.step();
    again.step(hand.inputs.back());
    ASSERT_EQ(again.now().state_hash, hand.now().state_hash) << i;
  }
  World other(box_wrist(), without(), 1);
  EXPECT_FALSE(other.read_state(bytes)) << "a procedure without fluid keeps none";
}

}  // namespace
}  // namespace carpus::simulation
