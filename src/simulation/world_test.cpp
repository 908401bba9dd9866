// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "procedure/aid.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/permission.hpp"

namespace carpus::simulation {
namespace {

using test::body_of;
using test::is_done;
using test::Operator;
using test::refusal_in;
using test::shot;
using test::simple;
using test::wrist;

TEST(World, OpensWithTheFirstInstrumentInTheFirstHandAndTheWristAsDeclared) {
  const World world(wrist(), test::exercise(), 1);
  const Snapshot& now = world.now();
  EXPECT_EQ(now.items[0].instrument, test::instrument("guide_wire"));
  EXPECT_EQ(now.items[0].hand, 0);
  EXPECT_EQ(now.hands[1].item, kNoItem);
  EXPECT_EQ(now.wrist.flexion_rad, test::kOpenFlexionRad);
  EXPECT_EQ(now.body_count, wrist().bones.size());
  EXPECT_EQ(now.patient_from_bone[body_of(BoneId::Radius)],
            (Pose<frame::Patient, frame::Bone>{Mat3::identity(), {}}));
}

TEST(World, TheWristStaysWithinItsLimitsAndRefusesWhatIsNoPose) {
  Operator op;
  op.bend({3.0, 0.0, 0.0, 500.0}, 4000);
  EXPECT_EQ(op.now().wrist.flexion_rad, test::kOpenFlexionRad);
  EXPECT_EQ(op.now().wrist.traction_n, 100.0);
  op.bend({0.0, -2.0, 0.0, 0.0}, 4000);
  EXPECT_EQ(op.now().wrist.radial_deviation_rad, -0.3);
  const WristPose before = op.now().wrist;
  const std::uint64_t bad = op.world().faults().bad_inputs;
  op.bend({std::numeric_limits<double>::quiet_NaN(), 0, 0, 0}, 10);
  op.bend({1e7, 0, 0, 0}, 10);
  EXPECT_EQ(op.now().wrist, before);
  EXPECT_EQ(op.world().faults().bad_inputs, bad + 20);
}

TEST(World, UndoBringsBackInstrumentsAndBoneButNotTheCost) {
  Operator op;
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::Undo))), Refusal::NothingToUndo);
  op.command(shot(0));
  op.place_on_entry({});
  op.drive_to(10.0);
  const Tick spent = op.now().tick;
  EXPECT_EQ(op.now().track_count, 1);
  op.command(simple(CommandKind::Undo));
  EXPECT_EQ(op.item().body, kNoBody);
  EXPECT_EQ(op.now().undos, 1U);
  EXPECT_EQ(op.now().shots, 1U);
  EXPECT_EQ(op.now().track_count, 0);
  EXPECT_GT(op.now().tick, spent);
  const auto record = op.world().operation_record();
  ASSERT_EQ(record.passes.size(), 1U);
  EXPECT_TRUE(record.passes[0].was_undone);
  double most = 0;
  op.place_on_entry({});
  op.hold(Driver::Forward, 30.0, 1);
  while (op.item().depth_mm < 2.0) {
    op.hold(Driver::Forward, 30.0, 1);
    most = std::max(most, op.now().hands[0].resistance_n);
    ASSERT_LT(op.now().tick, 90000U);
  }
  EXPECT_GT(most, 15.0) << "the bone is whole again";
}

TEST(World, BadInputChangesNothingAndIsCounted) {
  World world(wrist(), test::exercise(), 1);
  Input input;
  input.wrist = world.now().wrist;
  input.hands[0].tip_in_patient = {0, 40, 60};
  input.hands[1].tip_in_patient = {0, 90, 60};
  world.step(input);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  Input bad = input;
  for (HandInput& hand : bad.hands) {
    hand.tip_in_patient = {nan, inf, 0};
    hand.shaft_in_patient = {0, 0, 0};
    hand.thrust_n = nan;
    hand.driver = static_cast<Driver>(77);
    hand.guidance = static_cast<Guidance>(9);
  }
  bad.wrist = {nan, inf, -inf, 1e300};
  bad.command = {static_cast<CommandKind>(99), 200, 250, nan, inf};
  for (int i = 0; i < 100; ++i) {
    const Snapshot& now = world.step(bad);
    EXPECT_EQ(refusal_in(now), Refusal::NoSuchHand);
    for (const ItemView& item : now.items) ASSERT_TRUE(is_finite(item.tip_in_patient));
    for (const HandView& hand : now.hands) ASSERT_TRUE(is_finite(hand.force_in_patient));
  }
  EXPECT_EQ(world.faults().bad_inputs, 300U) << "two hands and a wrist";
  bad.command = {static_cast<CommandKind>(99), 0, 0, 0, 0};
  EXPECT_EQ(refusal_in(world.step(bad)), Refusal::UnknownCommand);
  bad.command = {CommandKind::TakeShot, 0, 0, nan, 0};
  EXPECT_EQ(refusal_in(world.step(bad)), Refusal::ShotOutOfRange);
  bad.command = {CommandKind::Take, 0, 254, 0, 0};
  EXPECT_EQ(refusal_in(world.step(bad)), Refusal::NotOnTheTray);
  bad.command = {CommandKind::PickUp, 0, 254, 0, 0};
  EXPECT_EQ(refusal_in(world.step(bad)), Refusal::NothingThere);
}

TEST(World, ARandomOperatorBreaksNothing) {
  World world(wrist(), test::exercise(), 1);
  Rng rng(31);
  Input input;
  input.wrist = world.now().wrist;
  const Vec3 centre = cases::test::synthetic_scaphoid().centre;
  for (int i = 0; i < 40000; ++i) {
    for (HandInput& hand : input.hands) {
      if (rng.below(200) == 0) {
        hand.tip_in_patient =
            centre + Vec3{rng.uniform(-15, 15), rng.uniform(-15, 15), rng.uniform(-15, 25)};
        hand.shaft_in_patient = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
      }
      if (rng.below(300) == 0) hand.driver = static_cast<Driver>(rng.below(3));
      if (rng.below(300) == 0) hand.thrust_n = rng.uniform(0, 60);
      if (rng.below(500) == 0) hand.guidance = static_cast<Guidance>(rng.below(2));
    }
    if (rng.below(1500) == 0) {
      input.wrist = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1),
                     rng.uniform(0, 100)};
    }
    input.command = {};
    if (rng.below(60) == 0) {
      input.command = {
          static_cast<CommandKind>(rng.below(7)), static_cast<std::uint8_t>(rng.below(2)),
          static_cast<std::uint8_t>(rng.below(24)), rng.uniform(-180, 180), rng.uniform(-60, 60)};
    }
    const Snapshot& now = world.step(input);
    for (std::uint8_t h = 0; h < kHands; ++h) {
      ASSERT_TRUE(is_finite(now.hands[h].force_in_patient));
      const std::uint8_t held = now.hands[h].item;
      if (held < kMaxItems) {
        ASSERT_EQ(now.items[held].hand, h);
      }
    }
    for (std::uint8_t k = 0; k < kMaxItems; ++k) {
      const ItemView& item = now.items[k];
      if (item.instrument == kNoInstrument) continue;
      ASSERT_TRUE(is_finite(item.tip_in_patient)) << "tick " << i;
      ASSERT_NEAR(length(item.shaft_in_patient), 1.0, 1e-6);
      if (item.hand < kHands) {
        ASSERT_EQ(now.hands[item.hand].item, k);
      }
      if (item.wire < kMaxItems) {
        ASSERT_NE(now.items[item.wire].instrument, kNoInstrument);
      }
    }
  }
  EXPECT_EQ(world.faults().forces_zeroed, 0U);
}

TEST(World, IsDeclinedForReasonsThatTheProcedureKnows) {
  Operator op;
  op.command(simple(CommandKind::Decline));
  EXPECT_FALSE(op.now().finished) << "no reason was said";
  Command decline = simple(CommandKind::Decline);
  decline.index = 0x80;
  op.command(decline);
  EXPECT_FALSE(op.now().finished) << "there is no such reason";
  decline.index = 0b11;
  op.command(decline);
  EXPECT_TRUE(op.now().finished);
  EXPECT_EQ(op.world().operation_record().declined_for, 0b11);
}

TEST(World, AidsAreCountedAndForgottenByNoUndo) {
  Operator op;
  Command hint = simple(CommandKind::UseAid);
  hint.index = static_cast<std::uint8_t>(procedure::Aid::Hint);
  op.command(hint);
  EXPECT_EQ(op.now().events[0].kind, EventKind::AidUsed);
  op.command(hint);
  op.command(simple(CommandKind::Undo));
  EXPECT_EQ(op.world().operation_record().aids, 0b100);
  EXPECT_EQ(op.world().operation_record().aids_used, 2U);
  hint.index = procedure::kAidCount;
  op.command(hint);
  EXPECT_EQ(op.now().events[0].kind, EventKind::Refused);
}

TEST(World, HasNoAidsWhenAssessed) {
  World world(wrist(), test::exercise(), 1, procedure::Mode::Assessed);
  Input input;
  input.command = simple(CommandKind::UseAid);
  const Snapshot& now = world.step(input);
  EXPECT_EQ(now.events[0].kind, EventKind::Refused);
  EXPECT_EQ(world.operation_record().aids_used, 0U);
}

TEST(World, StandsStillOnceFinished) {
  Operator op;
  op.command(simple(CommandKind::Finish));
  const Snapshot last = op.now();
  EXPECT_TRUE(last.finished);
  EXPECT_EQ(last.step, test::exercise().steps.size());
  op.hold(Driver::Forward, 30.0, 10);
  EXPECT_EQ(op.now().tick, last.tick);
  EXPECT_EQ(op.now().state_hash, last.state_hash);
}

TEST(World, StepsAreTickedOffByTheProcedureAndLostWithTheirWire) {
  Operator op;
  op.place_on_entry({});
  EXPECT_TRUE(is_done(op.now(), 0));
  EXPECT_EQ(op.now().step, 1);
  op.command(shot(0));
  op.drive_to(24.0);
  EXPECT_TRUE(is_done(op.now(), 1));
  EXPECT_FALSE(is_done(op.now(), 2)) << "that picture was taken before";
  op.command(shot(45));
  EXPECT_TRUE(is_done(op.now(), 2));
  op.hold(Driver::Reverse, 0.0, 6000);
  EXPECT_TRUE(is_done(op.now(), 0));
  EXPECT_FALSE(is_done(op.now(), 1));
  EXPECT_FALSE(is_done(op.now(), 2));
}

TEST(World, AShotKnowsHowTheForearmLay) {
  Operator op;
  op.bend({test::kOpenFlexionRad, 0, 0.5, 0});
  op.command(shot(10));
  const auto record = op.world().operation_record();
  ASSERT_EQ(record.shots.size(), 1U);
  EXPECT_NEAR(record.shots[0].rotation_deg, 10 - 0.5 * 180 / 3.14159265358979, 0.01);
  EXPECT_NEAR(record.shots[0].wrist.pronation_rad, 0.5, 1e-4);
}

TEST(World, NeedsATargetACtAndFields) {
  const auto make = [](const cases::CaseData& data) { return World(data, test::exercise(), 1); };
  cases::CaseData no_field = wrist();
  no_field.bones.front().distance_field = {};
  EXPECT_THROW(make(no_field), InvalidInput);
  cases::CaseData no_ct = wrist();
  no_ct.ct = {};
  EXPECT_THROW(make(no_ct), InvalidInput);
  cases::CaseData no_scaphoid = wrist();
  std::erase_if(no_scaphoid.bones,
                [](const cases::Bone& bone) { return bone.bone == BoneId::Scaphoid; });
  EXPECT_THROW(make(no_scaphoid), InvalidInput);
  procedure::Procedure no_tray = test::exercise();
  no_tray.tray.clear();
  EXPECT_THROW(World(wrist(), no_tray, 1), InvalidInput);
}

}  // namespace
}  // namespace carpus::simulation
