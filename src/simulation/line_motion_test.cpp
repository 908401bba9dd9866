// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::body_of;
using test::has_event;
using test::Operator;
using test::wrist;

TEST(LineMotion, DrillingNeedsThrustAboveTheResistanceAndFeelsTheCortex) {
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

TEST(LineMotion, DrillingLeavesATrackThroughWhichTheNextPassGoesFreely) {
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

TEST(LineMotion, ATipBesideAnOldTrackIsDrawnIntoIt) {
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

TEST(LineMotion, TellsOfTheFarSideAndOfWrongBones) {
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

TEST(LineMotion, WhatIsFixedInBoneGoesWithIt) {
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

}  // namespace
}  // namespace carpus::simulation
