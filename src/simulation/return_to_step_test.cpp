// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "simulation/operation_test_support.hpp"

namespace carpus::simulation {
namespace {

using test::Operator;
using test::refusal_in;
using test::take;

// Steps of the test's exercise, by their places.
constexpr std::uint8_t kTouch = 0;
constexpr std::uint8_t kDrive = 1;
constexpr std::uint8_t kMeasure = 3;
constexpr std::uint8_t kScrew = 4;

Command to_step(std::uint8_t step) { return {CommandKind::ReturnToStep, 0, step, 0, 0}; }

/// Through the bone, looked at, measured, a screw seated.
void fix(Operator& op) {
  op.place_on_entry({});
  op.drive_to(18.0);
  op.command(test::shot(0));
  op.command(take("depth_gauge", 1));
  op.command(test::simple(CommandKind::ReadGauge, 1));
  op.command(test::simple(CommandKind::PutDown, 1));
  op.command(take("acutrak_standard_1994_15"));
  op.bury(1.0);
}

TEST(ReturnToStep, BringsBackWhatWasThereBeforeItWasDoneAndCountsOnce) {
  Operator op;
  EXPECT_EQ(refusal_in(op.command(to_step(kDrive))), Refusal::NoWayBackToStep) << "not done yet";
  fix(op);
  ASSERT_EQ(op.now().completed_steps, 0b11111U);
  EXPECT_EQ(op.now().returnable_steps & 0b11010U, 0b11010U);
  EXPECT_EQ(op.now().returnable_steps & 1U << kTouch, 0U) << "nothing was kept before the touch";
  EXPECT_EQ(refusal_in(op.command(to_step(kTouch))), Refusal::NoWayBackToStep);
  EXPECT_EQ(refusal_in(op.command(to_step(31))), Refusal::UnknownCommand);

  op.command(to_step(kMeasure));
  EXPECT_EQ(op.now().completed_steps, 0b00111U) << "measured and screwed no more, the wire is in";
  EXPECT_EQ(op.now().gauge_reading_mm, -1.0);
  EXPECT_TRUE(op.item().in_target);
  EXPECT_GE(op.item().depth_mm, 18.0);

  const std::uint32_t revision = op.now().tissue_revision;
  op.command(to_step(kDrive));
  EXPECT_EQ(op.now().completed_steps, 1U << kTouch);
  EXPECT_EQ(op.item().body, kNoBody) << "the wire is in the hand, before the bone";
  EXPECT_EQ(op.now().track_count, 0) << "and the bone whole again";
  EXPECT_NE(op.now().tissue_revision, revision);
  EXPECT_EQ(op.now().undos, 2U) << "each way back counts once, however far it goes";
  EXPECT_EQ(op.now().shots, 1U) << "pictures stay spent";
  const auto record = op.world().operation_record();
  ASSERT_FALSE(record.passes.empty());
  EXPECT_TRUE(record.passes.front().was_undone);
  EXPECT_EQ(op.now().returnable_steps, 0U);

  fix(op);
  EXPECT_EQ(op.now().completed_steps, 0b11111U) << "it can be done again";
}

TEST(ReturnToStep, IsTheSameAsUndoingUntilThen) {
  Operator steps;
  Operator undos;
  fix(steps);
  fix(undos);
  steps.command(to_step(kScrew));
  while ((undos.now().completed_steps >> kScrew & 1U) != 0) {
    undos.command(test::simple(CommandKind::Undo));
  }
  EXPECT_EQ(steps.now().completed_steps, undos.now().completed_steps);
  EXPECT_EQ(steps.item().depth_mm, undos.item().depth_mm);
  EXPECT_EQ(steps.item().instrument, undos.item().instrument);
  EXPECT_EQ(steps.now().track_count, undos.now().track_count);
  EXPECT_EQ(steps.now().undos, 1U);
}

TEST(ReturnToStep, IsNoneInAnAssessedOperation) {
  World world(test::wrist(), test::exercise(), 1, procedure::Mode::Assessed);
  Input input;
  input.wrist = world.now().wrist;
  input.hands[0].tip_in_patient = {0, 40, 60};
  input.hands[1].tip_in_patient = {0, 90, 60};
  input.command = to_step(kDrive);
  EXPECT_EQ(refusal_in(world.step(input)), Refusal::NoUndoWhenAssessed);
}

TEST(ReturnToStep, IsReplayedToTheSameState) {
  std::vector<Input> inputs;
  std::uint64_t end = 0;
  {
    Operator op([&](const Input& input) { inputs.push_back(input); });
    fix(op);
    op.command(to_step(kDrive));
    end = op.hold(Driver::Off, 0.0, 50).state_hash;
  }
  World again(test::wrist(), test::exercise(), 1);
  for (const Input& input : inputs) again.step(input);
  EXPECT_EQ(again.now().state_hash, end);
}

}  // namespace
}  // namespace carpus::simulation
