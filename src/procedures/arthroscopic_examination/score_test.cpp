// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "arthroscopy/pathology_table.hpp"
#include "procedures/arthroscopic_examination/declared.hpp"

namespace carpus::procedures::arthroscopic_examination {
namespace {

using carpus::arthroscopy::PathologyTable;

/// Looked round for a minute; the answers and the truth, by place in data/pathology.json.
procedure::OperationRecord record_of(const cases::Grades& truth, const cases::Grades& answers) {
  procedure::OperationRecord record;
  record.finished = true;
  record.scope.emplace();
  record.scope->looking_ticks = 60'000;
  record.scope->entries = 1;
  record.scope->truth = truth;
  record.scope->answers = answers;
  return record;
}

cases::Grades all_well() {
  cases::Grades grades = cases::not_judged();
  const auto asked = static_cast<std::ptrdiff_t>(PathologyTable::generic().findings.size());
  std::fill(grades.begin(), grades.begin() + asked, std::uint8_t{0});
  return grades;
}

struct Judged {
  std::optional<double> value;
  std::string reason;
  double points = 0;
  double possible = 0;
  bool is_there = false;
};

Judged item(const procedure::OperationRecord& record, const std::string& id) {
  for (const procedure::ScoreItem& each : score({}, record).items) {
    if (each.id == id) {
      return {each.value, each.reason, each.points, each.points_possible, true};
    }
  }
  return {};
}

TEST(ExaminationScore, WhatIsNamedInItsGradeEarnsAll) {
  cases::Grades truth{};
  truth[0] = 3;
  truth[2] = 4;
  cases::Grades said = all_well();
  said[0] = 3;
  said[2] = 4;
  const auto record = record_of(truth, said);
  for (const char* id :
       {"findings_found", "grades_right", "findings_invented", "findings_unjudged"}) {
    const Judged judged = item(record, id);
    EXPECT_DOUBLE_EQ(judged.points, judged.possible) << id;
    EXPECT_GT(judged.possible, 0) << id;
  }
}

TEST(ExaminationScore, AGradeBesideTheTrueOneCountsHalfWhereGradesHaveAnOrder) {
  cases::Grades truth{};
  truth[0] = 3;  // Geissler
  cases::Grades said = all_well();
  said[0] = 2;
  EXPECT_EQ(item(record_of(truth, said), "grades_right").value, 50);
  EXPECT_EQ(item(record_of(truth, said), "findings_found").value, 100);
  said[0] = 1;
  EXPECT_EQ(item(record_of(truth, said), "grades_right").value, 0);
  truth = {};
  truth[2] = 3;  // Palmer: classes, not degrees
  said = all_well();
  said[2] = 4;
  EXPECT_EQ(item(record_of(truth, said), "grades_right").value, 0);
}

TEST(ExaminationScore, WhatIsMissedInventedOrLeftOutIsNamed) {
  cases::Grades truth{};
  truth[0] = 4;
  cases::Grades said = all_well();
  said[1] = 2;
  said[9] = cases::kNotJudged;
  const auto record = record_of(truth, said);
  const auto& findings = PathologyTable::generic().findings;
  EXPECT_EQ(item(record, "findings_found").value, 0);
  EXPECT_NE(item(record, "findings_found").reason.find(findings[0].label), std::string::npos);
  EXPECT_EQ(item(record, "findings_invented").value, 1);
  EXPECT_NE(item(record, "findings_invented").reason.find(findings[1].label), std::string::npos);
  EXPECT_EQ(item(record, "findings_unjudged").value, 1);
  EXPECT_NE(item(record, "findings_unjudged").reason.find(findings[9].label), std::string::npos);
}

TEST(ExaminationScore, AHealthyWristIsAnAnswerAndFindingsAreLeftOutThere) {
  const auto record = record_of({}, all_well());
  EXPECT_FALSE(item(record, "findings_found").is_there);
  EXPECT_FALSE(item(record, "grades_right").is_there);
  EXPECT_EQ(item(record, "findings_invented").value, 0);
  EXPECT_NE(item(record, "findings_invented").reason.find("healthy"), std::string::npos);
  double possible = 0;
  for (const auto& each : score({}, record).items) possible += each.points_possible;
  EXPECT_NEAR(possible, 100, 1e-9) << "what is left out is shared out";
}

TEST(ExaminationScore, WhoAnsweredNothingFoundNothing) {
  cases::Grades truth{};
  truth[5] = 2;
  const auto record = record_of(truth, cases::not_judged());
  EXPECT_EQ(item(record, "findings_found").value, 0);
  EXPECT_EQ(item(record, "findings_unjudged").value,
            static_cast<double>(PathologyTable::generic().findings.size()));
}

bool is_fulfilled(const procedure::OperationRecord& record, const std::string& id) {
  for (const procedure::MustHave& each : score({}, record).must_haves) {
    if (each.id == id) return each.fulfilled;
  }
  ADD_FAILURE() << id << " is no must-have";
  return false;
}

TEST(ExaminationScore, WhoMissesMoreThanHalfOrCallsEverythingTornHasNotExamined) {
  cases::Grades truth{};
  truth[0] = truth[2] = 2;
  cases::Grades said = all_well();
  EXPECT_FALSE(is_fulfilled(record_of(truth, said), "half_found"));
  said[2] = 1;
  EXPECT_TRUE(is_fulfilled(record_of(truth, said), "half_found")) << "one of two";
  EXPECT_TRUE(is_fulfilled(record_of({}, all_well()), "half_found")) << "nothing to be missed";
  said = all_well();
  said[3] = said[4] = 1;
  EXPECT_TRUE(is_fulfilled(record_of({}, said), "few_invented"));
  said[5] = 1;
  EXPECT_FALSE(is_fulfilled(record_of({}, said), "few_invented"));
}

TEST(ExaminationScore, FluidIsJudgedByWhatItHidAndWhatItDidToTheTissue) {
  auto record = record_of({}, all_well());
  EXPECT_FALSE(item(record, "clouded_share").value) << "whose scope was never in led none";
  record.scope->fluid.watched_ticks = 60'000;
  record.scope->fluid.used_ml = 40;
  for (const char* id : {"clouded_share", "pressure_over_limit_s", "fluid_in_tissue_ml"}) {
    EXPECT_EQ(item(record, id).value, 0) << id;
    EXPECT_DOUBLE_EQ(item(record, id).points, item(record, id).possible) << id;
  }
  EXPECT_NE(item(record, "fluid_in_tissue_ml").reason.find("40"), std::string::npos);
  record.scope->fluid.clouded_ticks = 30'000;
  record.scope->fluid.over_limit_ticks = 60'000;
  record.scope->fluid.tissue_ml = 10;
  EXPECT_EQ(item(record, "clouded_share").value, 50);
  EXPECT_EQ(item(record, "pressure_over_limit_s").value, 60);
  for (const char* id : {"clouded_share", "pressure_over_limit_s", "fluid_in_tissue_ml"}) {
    EXPECT_EQ(item(record, id).points, 0) << id;
  }
}

}  // namespace
}  // namespace carpus::procedures::arthroscopic_examination
