// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/amount_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "fields/distance_field.hpp"
#include "haptics/virtual_coupling.hpp"
#include "procedure/aid.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/permission.hpp"

namespace carpus::simulation {
namespace {

using test::body_of;
using test::has_event;
using test::Operator;
using test::refusal_in;
using test::shot;
using test::simple;
using test::take;
using test::wrist;

bool is_done(const Snapshot& now, unsigned step) { return (now.completed_steps >> step & 1U) != 0; }

double depth_in(const Snapshot& now, BoneId id, const Vec3& point) {
  const std::uint8_t body = body_of(id);
  const Vec3 local = (now.patient_from_bone[body].inverse() * Point<frame::Patient>{point}).v;
  return -fields::sample_distance(wrist().bones[body].distance_field, local).distance_mm;
}

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

TEST(World, AFreeInstrumentNeverEntersBoneWhateverTheHandAndTheWristDo) {
  for (const char* id : {"guide_wire", "probe", "needle_sleeve_14g"}) {
    World world(wrist(), test::exercise(), 1);
    Rng rng(7);
    double deepest = -1;
    const Vec3 centre = cases::test::synthetic_scaphoid().centre;
    Input input;
    input.wrist = world.now().wrist;
    input.hands[0].tip_in_patient = {0, 100, 0};
    input.hands[1].tip_in_patient = {0, 160, 0};
    input.command = take(id);
    world.step(input);
    input.command = {};
    for (int i = 0; i < carpus::test::amount(4000, 12000, 120000); ++i) {
      if (i % 50 == 0) {
        input.hands[0].tip_in_patient =
            centre + Vec3{rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-20, 40)};
        input.hands[0].shaft_in_patient = {rng.uniform(-1, 1), rng.uniform(-1, 1),
                                           rng.uniform(-1, 1)};
      }
      if (i % 2000 == 0) input.wrist.flexion_rad = rng.uniform(-0.6, 0.6);
      const Snapshot& now = world.step(input);
      const ItemView& item = now.items[now.hands[0].item];
      for (const BoneId bone : {BoneId::Scaphoid, BoneId::Radius, BoneId::Lunate}) {
        const double back = instruments::catalogue()[item.instrument].shape.back_z_mm();
        for (double along = 2; along < back; along += 3) {  // the shaft's middle line
          deepest = std::max(
              deepest, depth_in(now, bone, item.tip_in_patient + item.shaft_in_patient * along));
        }
      }
    }
    EXPECT_LT(deepest, 0.35) << id << ": what turns may cut in for a tick, by less than its radius";
  }
}

TEST(World, TheTipRestsOnTheSurfaceAndTheSpringPushesTheHandBack) {
  Operator op;
  op.place_on_entry({});
  for (int i = 0; i < 160; ++i) {  // pressed in at a hand's pace
    op.hand().tip_in_patient += op.inward() * 0.01;
    op.hold(Driver::Off, 0, 1);
  }
  const Snapshot& now = op.hold(Driver::Off, 0, 50);
  ASSERT_TRUE(now.hands[0].touching);
  EXPECT_EQ(now.hands[0].touched_body, body_of(BoneId::Scaphoid));
  EXPECT_NEAR(now.hands[0].contact_depth_mm, 2.0, 0.15);
  EXPECT_NEAR(depth_in(now, BoneId::Scaphoid, op.item().tip_in_patient), 0.0, 0.06);
  EXPECT_NEAR(dot(now.hands[0].force_in_patient, -op.inward()),
              2.0 * haptics::kContactStiffnessNPerMm, 0.4);
  EXPECT_TRUE(is_done(now, 0));
}

TEST(World, DrillingNeedsThrustAboveTheResistanceAndFeelsTheCortex) {
  Operator op;
  op.place_on_entry({});
  const Snapshot& idle = op.hold(Driver::Forward, 5.0, 200);
  EXPECT_NE(op.item().body, kNoBody);
  EXPECT_LT(op.item().depth_mm, 0.5) << "5 N do not open the subchondral bone";
  EXPECT_EQ(idle.passes, 1U);
  double greatest_at_entry = 0;
  double least_inside = 100;
  while (op.item().depth_mm < 12.0) {
    op.hold(Driver::Forward, 30.0, 1);
    const double r = op.now().hands[0].resistance_n;
    if (op.item().depth_mm < 2.0) greatest_at_entry = std::max(greatest_at_entry, r);
    if (op.item().depth_mm > 5.0) least_inside = std::min(least_inside, r);
    ASSERT_LT(op.now().tick, 60000U);
  }
  EXPECT_GT(greatest_at_entry, 15.0);
  EXPECT_LT(least_inside, 10.0);
}

TEST(World, DrillingLeavesATrackThroughWhichTheNextPassGoesFreely) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(12.0);
  ASSERT_EQ(op.now().track_count, 1);
  const TrackView& track = op.now().tracks[0];
  EXPECT_EQ(track.body, body_of(BoneId::Scaphoid));
  EXPECT_NEAR(distance(track.from_in_bone, track.to_in_bone), 12.0, 0.3);
  EXPECT_EQ(track.to_radius_mm, 0.57);
  const std::uint32_t revision = op.now().tissue_revision;
  EXPECT_GT(revision, 50U);
  EXPECT_LT(op.item().tip_hu, 250.0) << "the tip stands at the end of its own hole";
  op.hold(Driver::Reverse, 0.0, 3000);
  ASSERT_EQ(op.item().body, kNoBody);
  double most = 0;
  op.place_on_entry({});
  while (op.item().depth_mm < 10.0) {
    op.hold(Driver::Forward, 6.0, 1);
    most = std::max(most, op.now().hands[0].resistance_n);
    ASSERT_LT(op.now().tick, 120000U) << "depth " << op.item().depth_mm;
  }
  EXPECT_LT(most, 3.0) << "6 N were far from enough the first time";
  EXPECT_EQ(op.now().passes, 2U);
}

TEST(World, ATipBesideAnOldTrackIsDrawnIntoIt) {
  const auto off_line_at = [](bool has_track) {
    Operator op;
    if (has_track) {
      op.place_on_entry({});
      op.drive_to(20.0);
      op.hold(Driver::Reverse, 0.0, 5000);
    }
    op.place_on_entry({{0.9, 0, 0}, {0.9, 0, 0}});  // beside it, along it
    op.drive_to(18.0);
    const auto& axis = wrist().scaphoid.central_axis;
    const auto& pose = op.now().patient_from_bone[body_of(BoneId::Scaphoid)];
    const Vec3 tip = (pose.inverse() * Point<frame::Patient>{op.item().tip_in_patient}).v;
    const Vec3 along = normalized_or(axis.distal - axis.proximal, {});
    return length(cross(tip - axis.proximal, along));
  };
  const double undisturbed = off_line_at(false);
  const double drawn = off_line_at(true);
  EXPECT_LT(drawn, undisturbed - 0.05);
  EXPECT_GT(drawn, 0.0);
}

TEST(World, TellsOfTheFarSideAndOfWrongBones) {
  Operator op;
  op.place_on_entry({});
  bool left = false;
  bool wrong = false;
  for (int i = 0; i < 30000 && !(left && wrong); ++i) {
    op.hold(Driver::Forward, 50.0, 1);
    left = left || has_event(op.now(), EventKind::LeftFarSide);
    if (has_event(op.now(), EventKind::WrongBone)) {
      wrong = true;
      EXPECT_TRUE(left) << "the trapezium lies beyond the distal pole";
    }
  }
  EXPECT_TRUE(left);
  EXPECT_TRUE(wrong);
  const auto record = op.world().operation_record();
  ASSERT_EQ(record.passes.size(), 1U);
  EXPECT_EQ(record.passes[0].far_exits, 1U);
  EXPECT_EQ(record.passes[0].bodies_entered,
            1U << body_of(BoneId::Scaphoid) | 1U << body_of(BoneId::Trapezium));
  EXPECT_GT(record.passes[0].far_exit_mm, 0.3);
}

TEST(World, WhatIsFixedInBoneGoesWithIt) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(15.0);
  const auto in_bone = [&] {
    const auto pose = op.now().patient_from_bone[body_of(BoneId::Scaphoid)].inverse();
    return std::pair((pose * Point<frame::Patient>{op.item().tip_in_patient}).v,
                     (pose * Direction<frame::Patient>{op.item().shaft_in_patient}).v);
  };
  const auto [tip, shaft] = in_bone();
  const Vec3 tip_before = op.item().tip_in_patient;
  op.bend({0.1, 0.1, 0.4, 30.0});
  const auto [tip_after, shaft_after] = in_bone();
  EXPECT_GT(distance(op.item().tip_in_patient, tip_before), 5.0);
  EXPECT_NEAR(distance(tip, tip_after), 0.0, 1e-9);
  EXPECT_NEAR(distance(shaft, shaft_after), 0.0, 1e-9);
  EXPECT_NEAR(op.now().wrist.pronation_rad, 0.4, 1e-4);
  EXPECT_NEAR(op.now().wrist.traction_n, 30.0, 1e-9);
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

TEST(World, AFlatWireSkatesInsteadOfEngaging) {
  Operator op;
  const auto body = cases::test::synthetic_scaphoid();
  // Beside the proximal pole the surface falls away steeply under a wire along the axis.
  const auto& marks = wrist().scaphoid;
  const Vec3 outward = normalized_or(marks.central_axis.proximal - marks.central_axis.distal, {});
  const double z = dot(outward, body.rotation.column(2)) > 0 ? 0.75 : -0.75;
  const auto& pose = op.now().patient_from_bone[body_of(BoneId::Scaphoid)];
  const Vec3 p = (pose * Point<frame::Bone>{body.surface_point(
                             normalized_or(Vec3{0.0, std::sqrt(1 - z * z), z}, {}))})
                     .v;
  const Vec3 away = (pose * Direction<frame::Bone>{body.rotation.column(1)}).v;
  for (double side = 3.0; side > -0.2; side -= 0.01) {
    op.hand().tip_in_patient = p + away * side;
    op.hold(Driver::Off, 0, 1);
  }
  ASSERT_TRUE(op.now().hands[0].touching);
  const auto slips_in = [&](Driver driver, int ticks) {
    int slips = 0;
    for (int i = 0; i < ticks; ++i) {
      op.hold(driver, 20, 1);
      slips += has_event(op.now(), EventKind::Slipped) ? 1 : 0;
    }
    return slips;
  };
  EXPECT_EQ(slips_in(Driver::Forward, 5), 1) << "told once while the driver turns";
  EXPECT_EQ(op.item().body, kNoBody) << "68 degrees from the normal";
  EXPECT_EQ(slips_in(Driver::Off, 1), 0);
  EXPECT_EQ(slips_in(Driver::Forward, 2), 1) << "and again when it is started anew";
}

/// Whoever holds a wire holds it outside the patient.
TEST(World, AWireWhoseShaftLiesInTheForearmDoesNotGoIn) {
  Operator op;
  op.aim({});
  const Vec3 along_forearm = normalized_or(Vec3{0.1, -0.3, 1.0}, {});
  const auto drive = [&](const Vec3& shaft) {
    op.hand().shaft_in_patient = shaft;
    for (double away = 20.0; away > -0.5; away -= 0.05) {
      op.hand().tip_in_patient = op.entry() + shaft * away;
      op.hold(Driver::Off, 0.0, 1);
    }
    EXPECT_TRUE(op.now().hands[0].touching);
    op.hold(Driver::Forward, 30.0, 1);
    const bool is_told = has_event(op.now(), EventKind::ShaftUnderSkin);
    op.hold(Driver::Forward, 30.0, 300);
    return is_told;
  };
  EXPECT_TRUE(drive(along_forearm));
  EXPECT_EQ(op.item().body, kNoBody);
  op.hold(Driver::Off, 0.0, 1);
  EXPECT_FALSE(drive(-op.inward()));
  EXPECT_NE(op.item().body, kNoBody);
}

TEST(World, ASleeveInTheOtherHandLeadsTheWireAndKeepsItFromSkating) {
  Operator op;
  op.command(take("needle_sleeve_14g", 1));
  op.aim({{0.5, 0, 0}, {}});
  const Vec3 entry = op.entry();
  const Vec3 inward = op.inward();
  HandInput& sleeve = op.hand(1);
  sleeve.shaft_in_patient = -inward;
  for (double away = 60.0; away > 1.5; away -= 0.1) {
    sleeve.tip_in_patient = entry - inward * away;
    op.hold(Driver::Off, 0, 1);
  }
  op.hold(Driver::Off, 0, 50);
  const Vec3 aside = any_perpendicular(inward);
  for (double away = 50.0; away > -0.5; away -= 0.1) {
    // A hand that is a millimetre off and points elsewhere.
    op.hand().tip_in_patient = entry - inward * away + aside * 1.0;
    op.hand().shaft_in_patient = -inward + aside * 0.2;
    op.hold(Driver::Off, 0, 1);
  }
  const ItemView& led = op.now().items[op.now().hands[1].item];
  EXPECT_NEAR(distance(op.item().shaft_in_patient, led.shaft_in_patient), 0.0, 1e-12);
  EXPECT_LT(length(cross(op.item().tip_in_patient - led.tip_in_patient, led.shaft_in_patient)),
            1e-9);
  op.hold(Driver::Forward, 30.0, 1500);
  EXPECT_NE(op.item().body, kNoBody);
  EXPECT_NEAR(length(cross(op.item().shaft_in_patient, led.shaft_in_patient)), 0.0, 1e-9);
}

TEST(World, TheGaugeReadsTheWireWhereverItsTipIs) {
  Operator op;
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::NoWireToRideOn);
  op.place_on_entry({});
  op.drive_to(24.0);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::NoGaugeInHand);
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::None);
  op.command(simple(CommandKind::ReadGauge, 1));
  EXPECT_NEAR(op.now().gauge_reading_mm, op.item().depth_mm, 0.26);
  EXPECT_TRUE(is_done(op.now(), 3));
  op.command(simple(CommandKind::PutDown, 1));
  op.drive_to(33.0);  // out of the far side, which a gauge cannot know
  op.command(take("depth_gauge", 1));
  op.command(simple(CommandKind::ReadGauge, 1));
  EXPECT_NEAR(op.now().gauge_reading_mm, 33.0, 0.3);
}

/// Both are as long as each other: what the second stands out farther lies in the bone.
TEST(World, ASecondWireHeldBesideTheFirstMeasuresIt) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("second_wire", 1));
  const Vec3 aside = normalized_or(cross(op.inward(), Vec3{0, 0, 1}), {1, 0, 0}) * 2.0;
  op.hand(1).shaft_in_patient = -op.inward();
  op.hand(1).tip_in_patient = op.entry() + aside - op.inward() * 40.0;
  op.hold(Driver::Off, 0.0, 200);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::NoGaugeInHand)
      << "it stands on nothing yet";
  for (double away = 40.0; away > -1.0; away -= 0.05) {
    op.hand(1).tip_in_patient = op.entry() + aside - op.inward() * away;
    op.hold(Driver::Off, 0.0, 1);
  }
  ASSERT_TRUE(op.now().hands[1].touching);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::None);
  EXPECT_NEAR(op.now().gauge_reading_mm, 24.0, 1.0);
  op.hand(1).shaft_in_patient = normalized_or(-op.inward() + aside * 0.4, {});
  op.hold(Driver::Off, 0.0, 300);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::NoGaugeInHand)
      << "not along it";
}

TEST(World, ReamsOverTheWireAndHasTheWireAtHandAgain) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("cannulated_drill"));
  EXPECT_EQ(op.item().wire, 0);
  op.drive_to(12.0);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::PutDown))), Refusal::HandIsFull)
      << "a reamer in bone has to be drawn back";
  op.hold(Driver::Reverse, 0.0, 12000);
  EXPECT_EQ(op.item().instrument, test::instrument("guide_wire"));
  EXPECT_NEAR(op.world().operation_record().reamed_mm, 12.0, 0.1);
  EXPECT_EQ(op.now().track_count, 2);
}

TEST(World, AScrewHoldsByTheBoneThatIsLeftAroundIt) {
  const auto holding_after = [](bool is_spoilt) {
    Operator op;
    if (is_spoilt) {  // passes where its thread will run
      for (const double aside : {1.7, -1.7}) {
        op.place_on_entry({{aside, 0, 0}, {aside, 0, 0}});
        op.drive_to(20.0);
        op.hold(Driver::Reverse, 0.0, 5000);
      }
    }
    op.place_on_entry({});
    op.drive_to(24.0);
    op.command(take("acutrak_standard_1994_20"));
    EXPECT_NEAR(op.item().buried_mm, -20.0, 0.1);
    const double before = op.item().depth_mm;
    op.hold(Driver::Forward, 0.0, 500);
    EXPECT_EQ(op.item().depth_mm, before) << "no thrust, no bite";
    op.bury(1.0);
    EXPECT_TRUE(is_done(op.now(), 4));
    return op.now().holding_share;
  };
  const double whole = holding_after(false);
  const double spoilt = holding_after(true);
  EXPECT_GT(whole, 0.95);
  EXPECT_LT(spoilt, whole - 0.05);
  EXPECT_GT(spoilt, 0.3);
}

TEST(World, ASeatedScrewStaysWhenItIsLetGoAndBacksOutWhenTakenUpAgain) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("acutrak_standard_1994_20"));
  op.bury(0.5);
  const std::uint8_t screw = op.now().hands[0].item;
  EXPECT_EQ(refusal_in(op.command({CommandKind::PickUp, 1, 0, 0, 0})), Refusal::SomethingRidesOnIt);
  op.command(simple(CommandKind::PutDown));
  EXPECT_EQ(op.now().hands[0].item, kNoItem);
  EXPECT_EQ(op.now().items[screw].hand, kNoHand);
  EXPECT_NEAR(op.now().items[screw].buried_mm, 0.5, 0.01);
  EXPECT_EQ(op.now().step, 5) << "what was left out before is past";
  EXPECT_EQ(refusal_in(op.command({CommandKind::PickUp, 0, screw, 0, 0})), Refusal::None);
  op.hold(Driver::Reverse, 0.0, 1000);
  EXPECT_LT(op.item().buried_mm, 0.0);
  EXPECT_FALSE(is_done(op.now(), 4));
}

TEST(World, TheWireCanGoWhileTheScrewStays) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("acutrak_standard_1994_20"));
  op.bury(1.0);
  const std::uint8_t screw = op.now().hands[0].item;
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::PutDown))), Refusal::None);
  EXPECT_EQ(refusal_in(op.command({CommandKind::PickUp, 0, 0, 0, 0})), Refusal::None)
      << "a seated screw does not hold the wire on which it came";
  op.hold(Driver::Reverse, 0.0, 6000);
  EXPECT_EQ(op.item().body, kNoBody);
  EXPECT_NEAR(op.now().items[screw].buried_mm, 1.0, 0.01);
  EXPECT_TRUE(op.now().items[screw].in_target);
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
