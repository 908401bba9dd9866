// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Declining, as both procedures judge it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "cases/synthetic_case_test_support.hpp"
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"
#include "procedures/volar_scaphoid_fixation/declared.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using cases::RightAnswer;
using procedure::MustHave;
using procedure::OperationRecord;
using procedure::Procedure;
using procedure::ScoreReport;

cases::CaseData humpback() {
  cases::CaseData data = cases::test::synthetic_case();
  data.lesson.emplace();
  data.lesson->title = "Old humpback";
  data.lesson->right_answer = RightAnswer::Decline;
  data.lesson->reason = "It is flexed.";
  data.lesson->decline_for = {"flexed", "bone_lost"};
  return data;
}

std::uint8_t bits_of(const Procedure& procedure, std::initializer_list<std::string_view> ids) {
  unsigned bits = 0;
  for (const std::string_view id : ids) {
    const auto& all = procedure.decline.reasons;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& reason) { return reason.id == id; });
    EXPECT_NE(found, all.end()) << id;
    bits |= 1U << (found - all.begin());
  }
  return static_cast<std::uint8_t>(bits);
}

/// Looked at from PA and lateral, then declined.
OperationRecord declined(const Procedure& procedure,
                         std::initializer_list<std::string_view> reasons) {
  OperationRecord record;
  for (const double rotation_deg : {0.0, 90.0}) {
    record.shots.emplace_back().rotation_deg = rotation_deg;
  }
  record.declined_for = bits_of(procedure, reasons);
  record.finished = true;
  return record;
}

bool is_fulfilled(const ScoreReport& report, std::string_view id) {
  for (const MustHave& must : report.must_haves) {
    if (must.id == id) return must.fulfilled;
  }
  ADD_FAILURE() << "no condition " << id;
  return false;
}

class Declining : public ::testing::TestWithParam<const Procedure*> {};

TEST_P(Declining, RightlyAndForAllThatHoldsEarnsEverything) {
  const Procedure& procedure = *GetParam();
  const ScoreReport report =
      procedure.score(humpback(), declined(procedure, {"flexed", "bone_lost"}));
  EXPECT_TRUE(report.is_fixation_acceptable);
  EXPECT_DOUBLE_EQ(report.overall, 100);
  ASSERT_EQ(report.declined_for.size(), 2U);
  ASSERT_TRUE(report.answer.has_value());
  EXPECT_EQ(report.answer->title, "Old humpback");
}

TEST_P(Declining, ForHalfTheReasonsAndAWrongOneEarnsHalf) {
  const Procedure& procedure = *GetParam();
  const ScoreReport report =
      procedure.score(humpback(), declined(procedure, {"flexed", "arthritis"}));
  EXPECT_TRUE(report.is_fixation_acceptable);
  EXPECT_DOUBLE_EQ(report.overall, 50);
}

TEST_P(Declining, WithoutAReasonThatHoldsIsAGuess) {
  const Procedure& procedure = *GetParam();
  const ScoreReport report = procedure.score(humpback(), declined(procedure, {"no_fracture"}));
  EXPECT_FALSE(is_fulfilled(report, "reason"));
  EXPECT_EQ(report.overall, 0);
}

TEST_P(Declining, WithoutALookIsVoidWhenAssessed) {
  const Procedure& procedure = *GetParam();
  OperationRecord record = declined(procedure, {"flexed", "bone_lost"});
  record.shots.pop_back();
  const ScoreReport report = procedure.score(humpback(), record);
  EXPECT_FALSE(is_fulfilled(report, "judged"));
  EXPECT_EQ(report.overall, 0);
  const ScoreReport locked = procedure::locked_where_void(report);
  EXPECT_TRUE(locked.is_void);
  EXPECT_FALSE(locked.answer) << "nobody buys the answer by declining at once";
}

TEST_P(Declining, AfterDrillingIsTooLate) {
  const Procedure& procedure = *GetParam();
  OperationRecord record = declined(procedure, {"flexed", "bone_lost"});
  record.passes.emplace_back();
  EXPECT_EQ(procedure.score(humpback(), record).overall, 0);
}

TEST_P(Declining, WhatShouldBeFixedIsWrong) {
  const Procedure& procedure = *GetParam();
  cases::CaseData data = humpback();
  data.lesson->right_answer = RightAnswer::Fix;
  data.lesson->decline_for.clear();
  const ScoreReport report = procedure.score(data, declined(procedure, {"flexed"}));
  EXPECT_FALSE(is_fulfilled(report, "declining_is_right"));
  EXPECT_EQ(report.overall, 0);
}

TEST_P(Declining, WhereNobodyWroteALessonIsNotCalledRight) {
  const Procedure& procedure = *GetParam();
  const ScoreReport report =
      procedure.score(cases::test::synthetic_case(), declined(procedure, {"flexed"}));
  EXPECT_FALSE(report.is_fixation_acceptable);
  EXPECT_FALSE(report.answer);
}

TEST_P(Declining, FixingWhatShouldBeDeclinedIsNeverAcceptable) {
  const Procedure& procedure = *GetParam();
  const OperationRecord nothing;
  EXPECT_FALSE(is_fulfilled(procedure.score(humpback(), nothing), "fixing_is_right"));
  const ScoreReport without = procedure.score(cases::test::synthetic_case(), nothing);
  for (const MustHave& must : without.must_haves) {
    EXPECT_NE(must.id, "fixing_is_right") << "nobody wrote a lesson";
  }
}

INSTANTIATE_TEST_SUITE_P(ByBothWays,
                         Declining,
                         ::testing::Values(&dorsal_scaphoid_fixation::declared(),
                                           &volar_scaphoid_fixation::declared()),
                         [](const auto& each) { return each.param->id; });

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
