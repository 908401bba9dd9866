// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/sectioning_check.hpp"

#include <gtest/gtest.h>

namespace carpus::soft_tissue {
namespace {

using Kind = PublishedStatement::Kind;

RestingWrist wrist_with(double hand_flexion, double scaphoid, double lunate) {
  RestingWrist w;
  w.hand.flexion_deg = hand_flexion;
  w.scaphoid.flexion_deg = scaphoid;
  w.lunate.flexion_deg = lunate;
  w.is_settled = true;
  return w;
}

struct Made {
  SectioningTable table;
  SectioningResult result;
};

Made made() {
  Made m;
  m.table.cuts = {{"intact", "intact", {}}, {"sl", "SL", {"SL_"}}};
  m.table.directions = {{"extension", -1, 0}, {"flexion", 1, 0}};
  m.table.positions = {{"neutral", 0, 0}, {"flexion", 50, 0}};
  m.result.wrists = {{"intact",
                      {{"extension", {wrist_with(-60, -45, -24)}, 60, 0.1},
                       {"flexion", {wrist_with(80, 60, 40)}, 80, 0.2}},
                      {{"neutral", wrist_with(0, 1, 2)}, {"flexion", wrist_with(50, 40, 30)}}},
                     {"sl",
                      {{"extension", {wrist_with(-66, -55, -20)}, 66, 0.1},
                       {"flexion", {wrist_with(81, 70, 39)}, 81, 0.2}},
                      {{"neutral", wrist_with(0, 3, 0)}, {"flexion", wrist_with(50, 47, 30)}}}};
  return m;
}

StatementCheck check(Made& m, const PublishedStatement& s) {
  m.table.published = {s};
  return compare_with_published(m.result, m.table).front();
}

PublishedStatement statement(Kind kind, const char* cut, const char* place) {
  PublishedStatement s;
  s.kind = kind;
  s.cut = cut;
  s.place = place;
  s.limits = {0, 10};
  return s;
}

TEST(SectioningCheck, ReadsEachKindOfFigure) {
  Made m = made();
  EXPECT_NEAR(check(m, statement(Kind::Share, "intact", "extension")).ours, 75, 1e-9);
  EXPECT_NEAR(check(m, statement(Kind::RangeChange, "sl", "extension")).ours, 6, 1e-9);
  EXPECT_NEAR(check(m, statement(Kind::Range, "sl", "flexion")).ours, 81, 1e-9);
  EXPECT_NEAR(check(m, statement(Kind::Stiffness, "intact", "flexion")).ours, 0.2, 1e-9);
  EXPECT_NEAR(check(m, statement(Kind::BoneChange, "sl", "flexion")).ours, 7, 1e-9);
  EXPECT_NEAR(check(m, statement(Kind::SlAngleChange, "sl", "neutral")).ours, 4, 1e-9);
  PublishedStatement over = statement(Kind::RangeOver, "intact", "flexion");
  over.other_place = "extension";
  EXPECT_NEAR(check(m, over).ours, 20, 1e-9);
  PublishedStatement bone = statement(Kind::BoneFlexion, "intact", "flexion");
  bone.other_place = "neutral";
  bone.bone = BoneId::Lunate;
  EXPECT_NEAR(check(m, bone).ours, 28, 1e-9);
}

TEST(SectioningCheck, ReachedIsWithinTheLimitsAndMeasured) {
  Made m = made();
  PublishedStatement s = statement(Kind::RangeChange, "sl", "extension");
  EXPECT_TRUE(check(m, s).is_reached);
  s.limits = {-5, 5};
  EXPECT_FALSE(check(m, s).is_reached);
  EXPECT_TRUE(check(m, s).is_measured);
  s.limits = {0, 10};
  m.result.wrists[1].curves[0].steps.back().is_settled = false;
  EXPECT_FALSE(check(m, s).is_measured);
  EXPECT_FALSE(check(m, s).is_reached);
}

}  // namespace
}  // namespace carpus::soft_tissue
