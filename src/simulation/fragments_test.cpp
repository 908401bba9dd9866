// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments of a broken bone: pushed, led by a joystick, held together.
#include <gtest/gtest.h>

#include <algorithm>

#include "fields/distance_field.hpp"
#include "simulation/broken_wrist_test_support.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::broken_wrist;
using test::has_event;
using test::Operator;
using test::simple;
using test::take;
using test::wrist;

TEST(Fragments, AFragmentGivesWayToAPushUntilItMeetsTheOtherAndUndoBringsItBack) {
  const cases::CaseData& data = broken_wrist();
  const std::size_t proximal = data.bones.size() - 2;
  const std::size_t distal = data.bones.size() - 1;
  World world(data, test::exercise(), 1);
  Input input;
  input.wrist = world.now().wrist;
  input.hands[1].tip_in_patient = {0, 150, 0};
  const auto apart = [&] {
    return world.now().patient_from_bone[proximal].translation -
           world.now().patient_from_bone[distal].translation;
  };
  const Vec3 as_scanned = apart();
  const auto& pose = world.now().patient_from_bone[proximal];
  const auto& axis = data.scaphoid.central_axis;
  const Vec3 entry = (pose * Point<frame::Bone>{axis.proximal}).v;
  const Vec3 inward =
      (pose * Direction<frame::Bone>{normalized_or(axis.distal - axis.proximal, {})}).v;
  HandInput& hand = input.hands[0];
  hand.shaft_in_patient = -inward;
  for (double away = 25.0; away > -0.4; away -= 0.05) {
    hand.tip_in_patient = entry - inward * away;
    world.step(input);
  }
  hand.driver = Driver::Forward;
  hand.thrust_n = 12.0;
  for (int i = 0; i < 1500; ++i) world.step(input);
  const Vec3 pushed = apart() - as_scanned;
  EXPECT_GT(dot(pushed, inward), 0.5) << "along the push";
  EXPECT_LT(length(pushed), 2.02) << "ligaments hold it";
  const std::uint64_t hash = world.now().state_hash;
  World again(data, test::exercise(), 1);
  ASSERT_TRUE(again.read_state(world.write_state()).has_value());
  EXPECT_EQ(again.now().state_hash, hash);
  EXPECT_EQ(again.now().patient_from_bone[proximal], world.now().patient_from_bone[proximal]);
  hand.driver = Driver::Off;
  input.command = simple(CommandKind::Undo);
  world.step(input);
  EXPECT_NEAR(distance(apart(), as_scanned), 0.0, 1e-12);
}

TEST(Fragments, AHoleIsToldInEachBodyThatItMeets) {
  World world(broken_wrist(), test::exercise(), 1);
  Input input;
  input.wrist = world.now().wrist;
  input.hands[1].tip_in_patient = {0, 150, 0};
  const auto& pose = world.now().patient_from_bone[broken_wrist().bones.size() - 2];
  const auto& axis = broken_wrist().scaphoid.central_axis;
  const Vec3 entry = (pose * Point<frame::Bone>{axis.proximal}).v;
  const Vec3 inward =
      (pose * Direction<frame::Bone>{normalized_or(axis.distal - axis.proximal, {})}).v;
  HandInput& hand = input.hands[0];
  hand.shaft_in_patient = -inward;
  for (double away = 25.0; away > -0.4; away -= 0.05) {
    hand.tip_in_patient = entry - inward * away;
    world.step(input);
  }
  hand.driver = Driver::Forward;
  hand.thrust_n = 40.0;
  for (int i = 0; i < 20000 && world.now().items[0].depth_mm < 22.0; ++i) world.step(input);
  ASSERT_GE(world.now().items[0].depth_mm, 22.0);
  ASSERT_EQ(world.now().track_count, 2);
  EXPECT_NE(world.now().tracks[0].body, world.now().tracks[1].body);
  EXPECT_EQ(world.now().passes, 1U);
}

/// In the proximal fragment, beside the axis, and let go of by the driver.
class Joystick {
 public:
  Joystick() : world_(broken_wrist(), test::exercise(), 1) {
    input_.wrist = world_.now().wrist;
    input_.hands[1].tip_in_patient = {0, 150, 0};
    input_.command = take("joystick_wire");
    world_.step(input_);
    input_.command = {};
    const auto& axis = broken_wrist().scaphoid.central_axis;
    const auto& pose = world_.now().patient_from_bone[proximal()];
    const Vec3 entry = (pose * Point<frame::Bone>{axis.proximal}).v;
    as_scanned_ = pose;
    inward_ = (pose * Direction<frame::Bone>{normalized_or(axis.distal - axis.proximal, {})}).v;
    hand().shaft_in_patient = -inward_;
    for (double away = 25.0; away > -0.4; away -= 0.05) {
      hand().tip_in_patient = entry - inward_ * away;
      world_.step(input_);
    }
    hand().driver = Driver::Forward;
    hand().thrust_n = 40.0;
    for (int i = 0; i < 20000 && item().depth_mm < 5.0; ++i) world_.step(input_);
    hand().driver = Driver::Off;
    rest();
  }

  /// The hand at its wire.
  void rest() {
    hand().tip_in_patient = item().tip_in_patient;
    hand().shaft_in_patient = item().shaft_in_patient;
    hold(50);
  }
  void hold(int ticks) {
    for (int i = 0; i < ticks; ++i) world_.step(input_);
  }
  [[nodiscard]] static std::size_t proximal() { return broken_wrist().bones.size() - 2; }
  [[nodiscard]] const ItemView& item() const {
    return world_.now().items[world_.now().hands[0].item];
  }
  [[nodiscard]] HandInput& hand() { return input_.hands[0]; }
  [[nodiscard]] const Vec3& inward() const { return inward_; }
  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] Pose<frame::Patient, frame::Bone> pose() const {
    return world_.now().patient_from_bone[proximal()];
  }
  /// Before the wire that went in pushed it.
  [[nodiscard]] const Pose<frame::Patient, frame::Bone>& as_scanned() const { return as_scanned_; }

 private:
  World world_;
  Input input_;
  Vec3 inward_;
  Pose<frame::Patient, frame::Bone> as_scanned_;
};

double turned_by(const Pose<frame::Patient, frame::Bone>& a,
                 const Pose<frame::Patient, frame::Bone>& b) {
  const Mat3 between = a.rotation.transposed() * b.rotation;
  return 0.5 * (between.rows[0].x + between.rows[1].y + between.rows[2].z - 1.0);
}

TEST(Fragments, AJoystickTurnsTheFragmentAboutItsTip) {
  Joystick joystick;
  const auto before = joystick.pose();
  const Vec3 tip = joystick.item().tip_in_patient;
  const Vec3 shaft = joystick.item().shaft_in_patient;
  joystick.hand().shaft_in_patient = normalized_or(shaft + any_perpendicular(shaft) * 0.2, shaft);
  joystick.hold(3000);
  EXPECT_LT(turned_by(before, joystick.pose()), 0.995) << "5.7 degrees at least";
  EXPECT_GT(turned_by(before, joystick.pose()), 0.97) << "no further than the hand";
  EXPECT_NEAR(distance(joystick.item().tip_in_patient, tip), 0.0, 1.1) << "but for its slack";
  const auto turned = joystick.pose();
  joystick.rest();
  joystick.hold(500);
  EXPECT_NEAR(turned_by(turned, joystick.pose()), 1.0, 1e-6) << "it stays where it is left";
}

TEST(Fragments, AJoystickPullsTheFragmentAndNeverIntoTheOther) {
  Joystick joystick;
  const auto before = joystick.pose().translation;
  const auto at_first = joystick.world().operation_record();
  joystick.hand().tip_in_patient = joystick.item().tip_in_patient - joystick.inward() * 3.0;
  joystick.hold(2000);
  EXPECT_NEAR(dot(joystick.pose().translation - before, joystick.inward()), -2.0, 0.1)
      << "a millimetre of the way is slack";
  const auto record = joystick.world().operation_record();
  EXPECT_TRUE(record.fracture.is_apart);
  EXPECT_NEAR(record.fracture.gap_mm, at_first.fracture.gap_mm + 2.0, 0.15);
  ASSERT_EQ(record.displacements.size(), broken_wrist().bones.size());
  const auto moved = [](const procedure::OperationRecord& told) {
    return told.displacements[Joystick::proximal()].translation;
  };
  EXPECT_NEAR(distance(moved(record), moved(at_first)), 2.0, 0.15);
  joystick.hand().tip_in_patient = joystick.item().tip_in_patient + joystick.inward() * 15.0;
  joystick.hold(4000);
  const double forward = dot(joystick.pose().translation - before, joystick.inward());
  EXPECT_GT(forward, 1.0);
  EXPECT_LT(forward, 3.5) << "the other fragment is 3 mm away";
  const auto bytes = joystick.world().write_state();
  World again(broken_wrist(), test::exercise(), 1);
  ASSERT_TRUE(again.read_state(bytes).has_value());
  EXPECT_EQ(again.now().patient_from_bone[Joystick::proximal()], joystick.pose());
}

/// Of a piece in another bone, told at the vertices of its surface.
double deepest_in_others(const Snapshot& now, std::size_t piece) {
  const auto& bones = broken_wrist().bones;
  double deepest = 0.0;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (bones[b].bone == BoneId::Scaphoid) continue;
    const auto to = now.patient_from_bone[b].inverse() * now.patient_from_bone[piece];
    for (const Vec3& vertex : bones[piece].surface.vertices) {
      const auto seen =
          fields::sample_distance(bones[b].distance_field, (to * Point<frame::Bone>{vertex}).v);
      if (seen.is_inside_grid) deepest = std::max(deepest, -seen.distance_mm);
    }
  }
  return deepest;
}

TEST(Fragments, AJoystickLeadsAlongOtherBonesAndNeverIntoThem) {
  bool has_slid = false;
  for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0},
                          Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
    Joystick joystick;
    const double before = deepest_in_others(joystick.world().now(), Joystick::proximal());
    const Vec3 from = joystick.pose().translation;
    joystick.hand().tip_in_patient = joystick.item().tip_in_patient + way * 12.0;
    joystick.hold(4000);
    EXPECT_LE(deepest_in_others(joystick.world().now(), Joystick::proximal()), before + 0.1)
        << way.x << " " << way.y << " " << way.z;
    const Vec3 gone = joystick.pose().translation - from;
    EXPECT_GT(length(gone), 0.3) << "it is not stuck at the first touch";
    has_slid = has_slid || length(gone - way * dot(gone, way)) > 0.3;
  }
  EXPECT_TRUE(has_slid) << "in no direction was another bone in the way";
}

TEST(Fragments, FacesPressedOntoEachOtherHoldByFriction) {
  const auto led_across = [](double pressed_mm) {
    Joystick joystick;
    const Vec3 across = any_perpendicular(joystick.inward());
    joystick.hand().tip_in_patient = joystick.item().tip_in_patient + joystick.inward() * 15.0;
    joystick.hold(4000);
    joystick.rest();
    const Vec3 from = joystick.pose().translation;
    joystick.hand().tip_in_patient =
        joystick.item().tip_in_patient + joystick.inward() * pressed_mm + across * 3.0;
    joystick.hold(2000);
    return dot(joystick.pose().translation - from, across);
  };
  EXPECT_LT(led_across(8.0), 0.2) << "pressed on, 21 degrees beside its way";
  EXPECT_GT(led_across(0.0), 1.5) << "lifted off, it goes across";
}

TEST(Fragments, APieceThatTouchesStillTurns) {
  Joystick joystick;
  joystick.hand().tip_in_patient = joystick.item().tip_in_patient + joystick.inward() * 15.0;
  joystick.hold(4000);
  joystick.rest();
  const auto before = joystick.pose();
  const Vec3 shaft = joystick.item().shaft_in_patient;
  joystick.hand().shaft_in_patient = normalized_or(shaft + any_perpendicular(shaft) * 0.2, shaft);
  joystick.hold(3000);
  EXPECT_LT(turned_by(before, joystick.pose()), 0.995) << "5.7 degrees at least";
}

TEST(Fragments, APushNeverTakesBackALedFragment) {
  Joystick joystick;
  const auto before = joystick.as_scanned().translation;
  joystick.hand().tip_in_patient = joystick.item().tip_in_patient + joystick.inward() * 3.6;
  joystick.hold(2000);
  const double led = dot(joystick.pose().translation - before, joystick.inward());
  ASSERT_GT(led, 2.1) << "farther than a push alone takes it";
  joystick.rest();
  joystick.hand().driver = Driver::Forward;
  for (const double thrust_n : {2.0, 12.0, 40.0}) {
    joystick.hand().thrust_n = thrust_n;
    joystick.hold(200);
    EXPECT_GE(dot(joystick.pose().translation - before, joystick.inward()), led - 1e-9) << thrust_n;
  }
}

TEST(Fragments, WhatLiesInBothHoldsThem) {
  Joystick joystick;
  joystick.hand().driver = Driver::Forward;
  for (int i = 0; i < 40000 && joystick.item().depth_mm < 18.0; ++i) joystick.hold(1);
  ASSERT_GE(joystick.item().depth_mm, 18.0);
  joystick.hand().driver = Driver::Off;
  joystick.rest();
  const auto before = joystick.pose();
  joystick.hand().tip_in_patient -= joystick.inward() * 5.0;
  joystick.hold(500);
  EXPECT_EQ(joystick.pose(), before);
}

TEST(Compression, AScrewDrawsThePiecesTogetherThenPressesThem) {
  Operator op({}, broken_wrist());
  op.place_on_entry({});
  op.drive_to(24.0);
  const double gap = op.world().operation_record().fracture.gap_mm;
  op.command(take("acutrak_standard_1994_20"));
  op.bury(-11.0);
  EXPECT_NEAR(op.world().operation_record().fracture.gap_mm, gap, 0.5)
      << "not in both yet; the push alone brings them a little nearer";
  op.bury(1.0);
  const auto record = op.world().operation_record();
  EXPECT_LT(record.fracture.gap_mm, gap - 0.8);
  EXPECT_GE(record.compression_n, 0.0);
  EXPECT_EQ(record.stripped_screws, 0U);
}

TEST(Compression, InAWholeBoneAScrewIsTightWhenSeatedAndStripsWhenTurnedOn) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(28.0);
  op.command(take("acutrak_standard_1994_20"));
  op.bury(2.0);
  EXPECT_GT(op.now().compression_n, 50.0);
  EXPECT_LT(op.now().compression_n, 100.0);
  const double held = op.now().holding_share;
  bool stripped = false;
  for (int i = 0; i < 20000 && !stripped && op.item().buried_mm < 8.0; ++i) {
    op.hold(Driver::Forward, 40.0, 1);
    stripped = has_event(op.now(), EventKind::ScrewStripped);
  }
  EXPECT_TRUE(stripped);
  EXPECT_GT(op.item().buried_mm, 3.0) << "not where it should be seated";
  EXPECT_LT(op.now().holding_share, 0.5 * held);
  EXPECT_EQ(op.now().compression_n, 0.0);
  EXPECT_EQ(op.world().operation_record().stripped_screws, 1U);
  // Backed out it may be replaced, and undone it is gone: it was stripped all the same.
  op.command({CommandKind::Undo});
  EXPECT_EQ(op.world().operation_record().stripped_screws, 1U);
}

}  // namespace
}  // namespace carpus::simulation
