// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tubes laid across the way of a wire on the synthetic wrist: what turns in one harms it, for good.
#include <gtest/gtest.h>

#include "simulation/detail/structure_watch.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation {
namespace {

using test::Operator;

/// The wrist with a straight tube, held by the scaphoid's pose of the opening, so many mm beside
/// the central axis and 12 mm before its entry.
cases::CaseData wrist_with_tube(double beside_mm, double radius_mm) {
  cases::CaseData data = test::wrist();
  const World plain(test::wrist(), test::exercise(), 1);
  const auto& pose = plain.now().patient_from_bone[test::body_of(BoneId::Scaphoid)];
  const auto& hand = plain.now().patient_from_bone[test::body_of(BoneId::Capitate)];
  const auto& axis = data.scaphoid.central_axis;
  const Vec3 outward = normalized_or(axis.proximal - axis.distal, {0, 0, 1});
  const Vec3 across = any_perpendicular(outward);
  const Vec3 along = cross(outward, across);
  const Vec3 middle = axis.proximal + outward * 12.0 + across * beside_mm;
  const auto laid = [&](const Vec3& p) {  // where the hand takes it to
    return (hand.inverse() * (pose * Point<frame::Bone>{p})).v;
  };
  data.structures = {{"tube",
                      "a tendon",
                      anatomy::StructureKind::Tendon,
                      radius_mm,
                      BoneId::Radius,
                      {{laid(middle - along * 10.0), 1}, {laid(middle + along * 10.0), 1}}}};
  return data;
}

bool was_told(const Snapshot& now) {
  for (std::size_t i = 0; i < now.event_count; ++i) {
    if (now.events[i].kind == EventKind::StructureStruck) return true;
  }
  return false;
}

TEST(Structures, AWireThatTurnsBesideOneTellsHowNear) {
  const cases::CaseData data = wrist_with_tube(4.0, 1.0);
  Operator op({}, data);
  op.place_on_entry({});
  op.drive_to(5.0);
  const auto record = op.world().operation_record();
  ASSERT_EQ(record.structures.size(), 1U);
  EXPECT_FALSE(record.structures[0].was_struck);
  EXPECT_NEAR(record.structures[0].least_mm, 4.0 - 1.0 - 0.57, 0.15);
  EXPECT_EQ(record.structures[0].by, test::instrument("guide_wire"));
}

TEST(Structures, AWireThatTurnsInOneHarmsItWhateverIsUndone) {
  const cases::CaseData data = wrist_with_tube(0.5, 1.0);
  Operator op({}, data);
  op.place_on_entry({});
  EXPECT_FALSE(op.world().operation_record().structures[0].was_struck);  // it does not turn yet
  op.hold(Driver::Forward, 30.0, 1);
  EXPECT_TRUE(was_told(op.now()));
  op.drive_to(3.0);
  EXPECT_FALSE(was_told(op.now()));  // once
  op.command(test::simple(CommandKind::Undo));
  const auto record = op.world().operation_record();
  EXPECT_TRUE(record.structures[0].was_struck);
  EXPECT_LT(record.structures[0].least_mm, 0.0);
}

/// The second hand brings a sleeve along the axis to the bone and keeps it there.
void lead_by_sleeve(Operator& op) {
  op.command(test::take("needle_sleeve_14g", 1));
  op.aim({});
  op.hand(1).shaft_in_patient = -op.inward();
  for (double away = 25.0; away > 1.2; away -= 0.05) {
    op.hand(1).tip_in_patient = op.entry() - op.inward() * away;
    op.hold(Driver::Off, 0.0, 1);
  }
  op.hold(Driver::Off, 0.0, 400);
}

TEST(Structures, ASleevePutsTheWayAside) {
  const cases::CaseData data = wrist_with_tube(0.5, 1.0);
  Operator op({}, data);
  lead_by_sleeve(op);
  op.place_on_entry({});
  op.drive_to(5.0);
  ASSERT_GE(op.item().depth_mm, 5.0);
  EXPECT_FALSE(op.world().operation_record().structures[0].was_struck);
}

TEST(Structures, AWireThatWasLedComesOutOnItsWay) {
  const cases::CaseData data = wrist_with_tube(0.5, 1.0);
  Operator op({}, data);
  lead_by_sleeve(op);
  op.place_on_entry({});
  op.drive_to(5.0);
  op.command(test::simple(CommandKind::PutDown, 1));
  op.hold(Driver::Reverse, 0.0, 3000);
  ASSERT_EQ(op.item().body, kNoBody);
  EXPECT_FALSE(op.world().operation_record().structures[0].was_struck);
  op.hold(Driver::Off, 0.0, 10);
  op.hold(Driver::Reverse, 0.0, 10);
  EXPECT_TRUE(op.world().operation_record().structures[0].was_struck)
      << "what is let go of and turns again is bare";
}

/// A tube across the far end of the axis that lies partly in the bone.
TEST(Structures, WhatIsGeneratedIntoTheBoneIsStruckOnlyOutsideIt) {
  cases::CaseData data = wrist_with_tube(0.0, 1.0);
  const World plain(test::wrist(), test::exercise(), 1);
  const auto& pose = plain.now().patient_from_bone[test::body_of(BoneId::Scaphoid)];
  const auto& hand = plain.now().patient_from_bone[test::body_of(BoneId::Capitate)];
  const auto& axis = data.scaphoid.central_axis;
  const Vec3 outward = normalized_or(axis.distal - axis.proximal, {0, 0, 1});
  const Vec3 across = any_perpendicular(outward);
  const auto lay = [&](double out_mm) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 p = axis.distal + outward * out_mm + across * (i == 0 ? -10.0 : 10.0);
      data.structures[0].course[i].at = (hand.inverse() * (pose * Point<frame::Bone>{p})).v;
    }
  };
  lay(0.3);
  Operator op({}, data);
  op.place_on_entry({});
  op.drive_to(distance(axis.proximal, axis.distal) - 0.5);
  EXPECT_FALSE(op.world().operation_record().structures[0].was_struck);
  op.drive_to(distance(axis.proximal, axis.distal) + 1.0);
  EXPECT_TRUE(op.world().operation_record().structures[0].was_struck);
}

TEST(Structures, OfAKeyframeGoOnToTheSameHash) {
  const cases::CaseData data = wrist_with_tube(0.5, 1.0);
  std::vector<Input> inputs;
  Operator op([&](const Input& input) { inputs.push_back(input); }, data);
  op.place_on_entry({});
  op.drive_to(2.0);
  const auto bytes = op.world().write_state();
  World again(data, test::exercise(), 1);
  ASSERT_TRUE(again.read_state(bytes));
  EXPECT_TRUE(again.operation_record().structures[0].was_struck);
  inputs.clear();
  op.drive_to(4.0);
  for (const Input& input : inputs) again.step(input);
  EXPECT_EQ(again.now().state_hash, op.now().state_hash);
  // A case without them takes no such state.
  World other(test::wrist(), test::exercise(), 1);
  EXPECT_FALSE(other.read_state(bytes));
}

}  // namespace
}  // namespace carpus::simulation
