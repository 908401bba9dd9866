// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Wires that go through, are drawn through, tie bones together, bend and break.
#include <gtest/gtest.h>

#include "simulation/detail/wire_bend.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::body_of;
using test::has_event;
using test::Operator;
using test::refusal_in;
using test::simple;
using test::take;

constexpr Command kTakeNear{CommandKind::PickUp, 0, 0, 0, 0};
constexpr Command kTakeFar{CommandKind::PickUpFarEnd, 0, 0, 0, 0};

double near_end_out(const Operator& op) {
  return op.now().items[0].length_mm - op.now().items[0].depth_mm;
}

void hold_until(Operator& op, Driver driver, const std::function<bool()>& is_there) {
  for (int i = 0; i < 100000 && !is_there(); ++i) op.hold(driver, 30.0, 1);
  ASSERT_TRUE(is_there());
  op.hold(Driver::Off, 0.0, 1);
}

void drive_through(Operator& op) {
  op.place_on_entry({});
  hold_until(op, Driver::Forward, [&] { return op.now().items[0].far_end_is_out; });
}

TEST(Wires, AreTakenAtTheirFarEndOnlyWhereItIsOutOfTheSkin) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(15.0);
  op.command(simple(CommandKind::PutDown));
  EXPECT_EQ(refusal_in(op.command(kTakeFar)), Refusal::EndIsInside);
  EXPECT_EQ(refusal_in(op.command(kTakeNear)), Refusal::None);
  hold_until(op, Driver::Forward, [&] { return op.now().items[0].far_end_is_out; });
  op.command(simple(CommandKind::PutDown));
  EXPECT_EQ(refusal_in(op.command(kTakeFar)), Refusal::None);
  EXPECT_TRUE(op.now().items[0].by_far_end);
}

TEST(Wires, DrawnThroughLetTheWristBeStraightenedAndGoBack) {
  Operator op;
  drive_through(op);
  op.command(simple(CommandKind::PutDown));
  op.command(kTakeFar);
  const WristPose open = op.now().wrist;
  hold_until(op, Driver::Reverse, [&] { return near_end_out(op) <= 0.0; });
  op.command(simple(CommandKind::PutDown));
  EXPECT_EQ(refusal_in(op.command(kTakeNear)), Refusal::EndIsInside);
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::EndIsInside);
  WristPose straight = open;
  straight.flexion_rad = 0.0;
  EXPECT_NEAR(op.bend(straight).wrist.flexion_rad, 0.0, 1e-3);
  EXPECT_EQ(op.now().items[0].bend_rad, 0.0) << "nothing stands out over the radius";
  op.bend(open);
  op.command(kTakeFar);
  hold_until(op, Driver::Forward, [&] { return near_end_out(op) >= 50.0; });
  op.command(simple(CommandKind::PutDown));
  EXPECT_EQ(refusal_in(op.command(kTakeNear)), Refusal::None);
  EXPECT_FALSE(op.now().items[0].by_far_end);
  hold_until(op, Driver::Reverse, [&] { return op.item().depth_mm <= 20.0; });
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::None);
  const auto bytes = op.world().write_state();
  World again(test::wrist(), test::exercise(), 1);
  ASSERT_TRUE(again.read_state(bytes).has_value());
  EXPECT_EQ(again.now().items, op.now().items);
}

TEST(Wires, DrawnAllTheWayThroughAreFreeInTheHand) {
  Operator op;
  drive_through(op);
  op.command(simple(CommandKind::PutDown));
  op.command(kTakeFar);
  hold_until(op, Driver::Reverse, [&] { return op.item().body == kNoBody; });
  EXPECT_GT(dot(op.item().shaft_in_patient, op.inward()), 0.9) << "the hand is beyond the bone";
  EXPECT_EQ(op.item().hand, 0);
}

TEST(Wires, ThatStandOutOverTheRadiusBendAndBreakWhenTheWristIsStraightened) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(20.0);
  op.command(simple(CommandKind::PutDown));
  const WristPose open = op.now().wrist;
  WristPose pose = open;
  bool bent = false;
  while (!bent && pose.flexion_rad > -test::kOpenFlexionRad) {
    pose.flexion_rad -= 0.01;
    bent = has_event(op.bend(pose, 1), EventKind::WireBent);
    for (int i = 0; i < 15 && !bent; ++i) {
      bent = has_event(op.hold(Driver::Off, 0, 1), EventKind::WireBent);
    }
  }
  ASSERT_TRUE(bent);
  const ItemView& wire = op.now().items[0];
  EXPECT_GT(wire.bend_rad, 0.0);
  EXPECT_NEAR(wire.bent_at_mm, wire.depth_mm, 1e-9) << "at the bone";
  op.bend(open);
  EXPECT_GT(op.now().items[0].bend_rad, 0.0) << "for good";
  EXPECT_GT(op.world().operation_record().most_bend_rad, 0.0);
  pose.flexion_rad = -test::kOpenFlexionRad;
  op.bend(pose);
  EXPECT_EQ(op.world().operation_record().broken_wires, 1U);
  EXPECT_NEAR(op.now().items[0].length_mm, op.now().items[0].depth_mm, 1e-9);
  op.bend(open);
  EXPECT_EQ(refusal_in(op.command(kTakeNear)), Refusal::EndIsInside) << "nothing is left to hold";
  op.command(simple(CommandKind::Undo));
  EXPECT_EQ(op.world().operation_record().broken_wires, 1U) << "harm stays";
}

TEST(Wires, BentByMoreThanALittleLetNothingRunOverThem) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(20.0);
  WristPose pose = op.now().wrist;
  while (op.now().items[0].bend_rad < 0.15 && pose.flexion_rad > -test::kOpenFlexionRad) {
    pose.flexion_rad -= 0.005;
    op.bend(pose, 8);
  }
  ASSERT_GE(op.now().items[0].bend_rad, 0.15);
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::WireIsBent);
}

TEST(WireBend, IsThatOfACantileverBeyondItsElasticWay) {
  // 0.6 % strain over 0.57 mm: a curvature of 0.01053 per mm; a third of it by 30^2 mm is 3.16 mm.
  EXPECT_EQ(detail::lasting_bend_rad(3.15, 30.0, 0.57), 0.0);
  EXPECT_NEAR(detail::lasting_bend_rad(5.158, 30.0, 0.57), 0.1, 1e-4);
  EXPECT_GT(detail::lasting_bend_rad(2.0, 10.0, 0.8), detail::lasting_bend_rad(2.0, 10.0, 0.57))
      << "a thicker wire yields earlier";
  const Vec3 along{0, 0, 1};
  const Vec3 turned = detail::bent(along, {1, 0, 0}, detail::kBreakingRad);
  EXPECT_NEAR(dot(turned, along), 0.8253, 0.005);
}

TEST(Wires, ThroughABoneOfTheHandTakeTheTargetAlong) {
  Operator op;
  op.place_on_entry({});
  const WristPose open = op.now().wrist;
  hold_until(op, Driver::Forward, [&] { return has_event(op.now(), EventKind::WrongBone); });
  const std::uint8_t scaphoid = body_of(BoneId::Scaphoid);
  const std::uint8_t other = op.now().items[0].tip_body;
  ASSERT_NE(other, kNoBody);
  const auto relative = [&] {
    const auto& poses = op.now().patient_from_bone;
    return poses[other].inverse() * poses[scaphoid];
  };
  const auto before = relative();
  WristPose pose = open;
  pose.flexion_rad -= 0.3;
  op.bend(pose);
  EXPECT_LT(op.now().wrist.flexion_rad, open.flexion_rad - 0.05) << "the wrist moves";
  EXPECT_NEAR(distance(relative().translation, before.translation), 0.0, 1e-6);
  hold_until(op, Driver::Reverse, [&] { return op.now().items[0].depth_mm < 15.0; });
  op.bend(open);
  EXPECT_FALSE(has_event(op.now(), EventKind::WristStopped));
  World plain(test::wrist(), test::exercise(), 1);
  EXPECT_NEAR(distance(op.now().patient_from_bone[scaphoid].translation,
                       plain.now().patient_from_bone[scaphoid].translation),
              0.0, 1e-3)
      << "let go of, it lies where the wrist takes it";
}

}  // namespace
}  // namespace carpus::simulation
