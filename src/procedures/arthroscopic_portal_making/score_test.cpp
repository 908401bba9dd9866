// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "anatomy/structure_table.hpp"
#include "procedures/arthroscopic_portal_making/declared.hpp"
#include "procedures/arthroscopic_portal_making_harder/declared.hpp"

namespace carpus::procedures::arthroscopic_portal_making {
namespace {

procedure::OperationRecord perfect() {
  procedure::OperationRecord record;
  record.ticks = 300'000;
  procedure::MakingFacts& facts = record.making.emplace();
  facts.made = 2;
  for (procedure::PortalMade& made : facts.portal) {
    made.landmark_felt = 0b11'1011;
    made.place_felt = 0b11'1110'0000;
    made.passes = 1;
    made.needle = made.sheath = {true, 0.8, 1.2, 1.0};
    made.cut = {4.5, 1.6, 1.0, 0.3};
    made.overrun_mm = 3.0;
  }
  return record;
}

procedure::ScoreReport graded(const procedure::OperationRecord& record) {
  return declared().score(cases::CaseData{}, record);
}

double points(const procedure::OperationRecord& record, const std::string& id) {
  const procedure::ScoreReport report = graded(record);
  const auto at = std::find_if(report.items.begin(), report.items.end(),
                               [&](const auto& item) { return item.id == id; });
  EXPECT_NE(at, report.items.end()) << id;
  return at == report.items.end() ? -1 : at->points;
}

/// Points of one measure after a change that must cost nowhere else.
double after(const char* id, void (*change)(procedure::PortalMade&)) {
  procedure::OperationRecord record = perfect();
  change(record.making->portal[0]);
  const procedure::ScoreReport whole = graded(perfect());
  const procedure::ScoreReport report = graded(record);
  for (std::size_t i = 0; i < report.items.size(); ++i) {
    if (report.items[i].id == id) continue;
    EXPECT_DOUBLE_EQ(report.items[i].points, whole.items[i].points) << report.items[i].id;
  }
  return points(record, id);
}

TEST(PortalMakingScore, FeltPrickedCutSpreadAndEnteredEarnsAll) {
  EXPECT_DOUBLE_EQ(graded(perfect()).overall, 100.0);
}

TEST(PortalMakingScore, NothingDoneHasNoFaultsToBePraisedFor) {
  procedure::OperationRecord record;
  record.making.emplace();
  EXPECT_DOUBLE_EQ(graded(record).overall, 0.0);
  EXPECT_DOUBLE_EQ(graded({}).overall, 0.0);
}

TEST(PortalMakingScore, OneOfTwoIsLessThanHalf) {
  procedure::OperationRecord record = perfect();
  record.making->made = 1;
  EXPECT_LT(graded(record).overall, 50.0);
  EXPECT_GT(graded(record).overall, 10.0);
}

TEST(PortalMakingScore, AJointReachedByLuckLosesForItsPlace) {
  EXPECT_DOUBLE_EQ(after("first_needle_off_mm", [](auto& made) { made.needle.inner_off_mm = 6; }),
                   0.0);
  EXPECT_DOUBLE_EQ(after("first_needle_off_mm", [](auto& made) { made.needle.skin_off_mm = 6; }),
                   0.0)
      << "the worse of both counts";
  EXPECT_DOUBLE_EQ(after("first_sheath_off_mm", [](auto& made) { made.sheath.inner_off_mm = 6; }),
                   0.0);
}

TEST(PortalMakingScore, EachFaultCostsWhereItBelongsAndNowhereElse) {
  EXPECT_DOUBLE_EQ(
      after("first_needle_tilt_deg", [](auto& made) { made.needle.tilt_cosine = 0.8; }), 0.0)
      << "37 degrees";
  EXPECT_DOUBLE_EQ(after("first_cut_length_mm", [](auto& made) { made.cut.length_mm = 12; }), 0.0);
  EXPECT_DOUBLE_EQ(after("first_cut_depth_mm", [](auto& made) { made.cut.deepest_mm = 5; }), 0.0);
  EXPECT_DOUBLE_EQ(after("cut_direction_deg", [](auto& made) { made.cut.along_cosine = 0.1; }),
                   0.0);
  EXPECT_DOUBLE_EQ(after("needle_passes", [](auto& made) { made.passes = 7; }), 0.0);
  EXPECT_DOUBLE_EQ(after("bone_strikes", [](auto& made) { made.bone_strikes = 4; }), 0.0);
  EXPECT_DOUBLE_EQ(after("overrun_mm", [](auto& made) { made.overrun_mm = 12; }), 0.0);
  EXPECT_DOUBLE_EQ(after("out_of_order",
                         [](auto& made) {
                           made.out_of_order =
                               procedure::kCutBeforeNeedle | procedure::kSheathBeforeSpread;
                         }),
                   0.0);
}

TEST(PortalMakingScore, WhatIsTouchedOnceIsNotFelt) {
  const double whole = points(perfect(), "palpated_share");
  const double once =
      after("palpated_share", [](auto& made) { made.landmark_felt = made.place_felt = 1; });
  EXPECT_LT(once, 0.65 * whole);
  const double spot_alone = after("palpated_share", [](auto& made) { made.landmark_felt = 0; });
  EXPECT_LT(spot_alone, 0.8 * whole);
}

/// Portals 3-4 and VR of a wrist with its artery, the palmar branch and the flexor.
cases::CaseData wrist_with_vr() {
  cases::CaseData data;
  cases::ArthroscopicMap map;
  for (const char* id : {"3-4", "VR"}) {
    map.portals.emplace_back();
    map.portals.back().id = id;
  }
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
  const auto add = [&data](const char* id, anatomy::StructureKind kind) {
    cases::Structure made;
    made.id = made.name = id;
    made.kind = kind;
    data.structures.push_back(made);
  };
  add("radial_artery", anatomy::StructureKind::Artery);
  add("median_palmar", anatomy::StructureKind::Nerve);
  add("fcr", anatomy::StructureKind::Tendon);
  return data;
}

procedure::ScoreItem harder_item(const procedure::OperationRecord& record,
                                 const char* id,
                                 const cases::CaseData& data = wrist_with_vr()) {
  const procedure::ScoreReport report =
      arthroscopic_portal_making_harder::declared().score(data, record);
  for (const procedure::ScoreItem& item : report.items) {
    if (item.id == id) return item;
  }
  ADD_FAILURE() << id;
  return {};
}

TEST(PortalMakingScore, TellsHowNearAnythingCameToWhatThePortalEndangers) {
  procedure::OperationRecord record = perfect();
  record.making->asked = {0, 1};
  record.structures = {{0, 5.8, false, 0}, {1, 2.4, false, 0}, {2, -0.5, false, 0}};
  const procedure::ScoreItem told = harder_item(record, "second_endangered_mm");
  EXPECT_DOUBLE_EQ(*told.value, 2.4) << "of a tendon that gives way nothing is judged";
  EXPECT_NE(told.reason.find("radial_artery 5.8 mm, median_palmar 2.4 mm, fcr not struck."),
            std::string::npos)
      << told.reason;
  record.structures[1] = {1, -0.1, true, 0};
  EXPECT_DOUBLE_EQ(harder_item(record, "structures_struck").points, 0.0);
  EXPECT_NE(harder_item(record, "second_endangered_mm").reason.find("median_palmar struck"),
            std::string::npos);
  record.making->made = 1;
  EXPECT_FALSE(harder_item(record, "second_endangered_mm").value.has_value());
}

TEST(PortalMakingScore, WhereNothingIsGeneratedNothingWasSpared) {
  procedure::OperationRecord record = perfect();
  record.making->asked = {0, 1};
  record.making->portal[1].strayed_mm = 4.0;
  EXPECT_GT(harder_item(record, "structures_struck").points, 0.0);
  record.making->portal[1].strayed_mm = 7.0;
  const procedure::ScoreItem unjudged = harder_item(record, "structures_struck");
  EXPECT_FALSE(unjudged.value.has_value());
  EXPECT_DOUBLE_EQ(unjudged.points, 0.0);
  EXPECT_NE(unjudged.reason.find("the median nerve"), std::string::npos);
  record.making->portal[1].strayed_mm = 0.0;
  record.making->portal[0].strayed_mm = 7.0;
  EXPECT_GT(harder_item(record, "structures_struck").points, 0.0) << "round 3-4 all is generated";
}

TEST(PortalMakingScore, WhereAllIsGeneratedAllIsJudged) {
  cases::CaseData whole = wrist_with_vr();
  whole.structures.clear();
  for (const auto& tabled : anatomy::StructureTable::generic().structures) {
    whole.structures.emplace_back();
    whole.structures.back().id = tabled.id;
    whole.structures.back().name = tabled.name;
    whole.structures.back().kind = tabled.kind;
  }
  procedure::OperationRecord record = perfect();
  record.making->asked = {0, 1};
  record.making->portal[1].strayed_mm = 7.0;
  EXPECT_GT(harder_item(record, "structures_struck", whole).points, 0.0);
  const std::string struck = "median nerve";
  for (std::uint8_t s = 0; s < whole.structures.size(); ++s) {
    if (whole.structures[s].name == struck) record.structures = {{s, -0.2, true, 0}};
  }
  const procedure::ScoreItem item = harder_item(record, "structures_struck", whole);
  EXPECT_DOUBLE_EQ(item.points, 0.0);
  EXPECT_NE(item.reason.find(struck), std::string::npos) << item.reason;
}

TEST(PortalMakingScore, ASheathWithoutANeedleBeforeItEarnsNothingForOne) {
  EXPECT_LT(graded([] {
              procedure::OperationRecord record = perfect();
              record.making->portal[0].needle = {};
              return record;
            }())
                .overall,
            90.0);
}

}  // namespace
}  // namespace carpus::procedures::arthroscopic_portal_making
