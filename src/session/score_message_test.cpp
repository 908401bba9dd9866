// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/score_message.hpp"

#include <gtest/gtest.h>

namespace carpus::session {
namespace {

TEST(ScoreMessage, SaysWhatWasNotMeasuredAndReadsBackAsItWas) {
  procedure::ScoreReport report;
  report.overall = 40;
  report.items.resize(2);
  report.items[0].id = "length_mm";
  report.items[1].id = "angle_deg";
  report.items[1].value = 3.5;
  report.items[1].grade = procedure::Grade::Good;
  report.must_haves.push_back({"inside", "Inside the bone", true});
  const protocol::ScoreReport message = score_message(report);
  const auto read = protocol::parse_stored_score(protocol::serialize_stored_score(message));
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(*read, message);
  ASSERT_EQ(read->items.size(), 2U);
  EXPECT_EQ(read->items[0].value, std::nullopt);
  EXPECT_EQ(read->items[0].grade, protocol::Grade::NotMeasured);
  EXPECT_EQ(read->items[1].value, 3.5);
  EXPECT_EQ(read->overall, 40);
  EXPECT_TRUE(read->must_haves.at(0).fulfilled);
  EXPECT_EQ(read->placement.screw, std::nullopt);
}

TEST(ScoreMessage, SaysOnWhichBoneWhenAndByWhatCartilageWasScuffed) {
  procedure::ScoreReport report;
  EXPECT_EQ(score_message(report).scuffs, std::nullopt);
  report.scuffs.push_back({BoneId::Lunate,
                           BonePart::Whole,
                           "Hook probe",
                           {4200, 3, {1, 2, 3}, 9.5, 0, procedure::Scuffing::Pressed}});
  report.scuffs.push_back(
      {BoneId::Radius, BonePart::Whole, "Punch", {9, 0, {}, 0, 0, procedure::Scuffing::Bitten}});
  const protocol::ScoreReport message = score_message(report);
  const auto read = protocol::parse_stored_score(protocol::serialize_stored_score(message));
  ASSERT_TRUE(read.has_value()) << read.error();
  ASSERT_EQ(read->scuffs->size(), 2U);
  const protocol::ScuffedPlace& first = read->scuffs->front();
  EXPECT_EQ(first.bone, "lunate");
  EXPECT_EQ(first.at_mm, (Vec3{1, 2, 3}));
  EXPECT_EQ(first.tick, 4200);
  EXPECT_EQ(first.how, protocol::Scuffing::Pressed);
  EXPECT_EQ(first.force_n, 9.5);
  EXPECT_EQ(first.instrument, "Hook probe");
  EXPECT_EQ(read->scuffs->back().how, protocol::Scuffing::Bitten);
}

TEST(ScoreMessage, PutsScrewAndWireWhereTheyLie) {
  procedure::ScoreReport report;
  report.placement.wire = procedure::PlacedLine{{1, 2, 3}, {4, 5, 6}};
  report.placement.screw = procedure::PlacedLine{{7, 8, 9}, {10, 11, 12}};
  report.placement.screw_tip_diameter_mm = 3.5;
  report.placement.screw_tail_diameter_mm = 4.1;
  report.placement.pieces.push_back(
      {BoneId::Scaphoid, BonePart::Distal, {rotation_from_quaternion(0.8, 0, 0.6, 0), {1, 2, 3}}});
  const protocol::Placement placement = score_message(report).placement;
  ASSERT_TRUE(placement.pieces.has_value());
  ASSERT_EQ(placement.pieces->size(), 1U);
  EXPECT_EQ(placement.pieces->front().name, "scaphoid_distal");
  EXPECT_NEAR(placement.pieces->front().pose.quaternion[2], 0.6, 1e-12);
  EXPECT_EQ(placement.pieces->front().pose.translation_mm, (Vec3{1, 2, 3}));
  EXPECT_EQ(placement.wire, (protocol::PlacedWire{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(placement.screw, (protocol::PlacedScrew{{7, 8, 9}, {10, 11, 12}, 3.5, 4.1}));
}

}  // namespace
}  // namespace carpus::session
