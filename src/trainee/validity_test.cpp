// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/validity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace carpus::trainee {
namespace {

TEST(Validity, TheAreaUnderTheCurveCountsPairs) {
  const std::array<double, 3> better{3, 5, 7};
  const std::array<double, 2> worse{5, 1};
  // Of six pairs: 3 > 1, 5 = 5, 5 > 1, 7 > 5, 7 > 1, 3 < 5.
  EXPECT_DOUBLE_EQ(separation_of(better, worse).auc, 4.5 / 6.0);
  EXPECT_DOUBLE_EQ(separation_of(worse, better).auc, 1.5 / 6.0);
}

TEST(Validity, TheEffectSizeIsTheDifferenceByThePooledDeviation) {
  const std::array<double, 2> better{8, 12};  // mean 10, variance 8
  const std::array<double, 2> worse{3, 5};    // mean 4, variance 2
  EXPECT_NEAR(*separation_of(better, worse).effect_size, 6.0 / std::sqrt(5.0), 1e-12);
  const std::array<double, 2> same{4, 4};
  EXPECT_FALSE(separation_of(same, same).effect_size.has_value());
  EXPECT_DOUBLE_EQ(separation_of(same, same).auc, 0.5);
  const std::array<double, 3> thirds{2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  const std::array<double, 3> tenths{0.1, 0.1, 0.1};
  EXPECT_FALSE(separation_of(thirds, tenths).effect_size.has_value());
}

procedure::Procedure one_rule() {
  procedure::Procedure procedure;
  procedure.id = "test";
  procedure::ScoreRule rule;
  rule.id = "offset_mm";
  rule.good.high = 1.0;
  rule.fail.high = 3.0;
  rule.weight = 1.0;
  procedure.rules.items = {rule};
  return procedure;
}

ScoredOperation operation(Skill skill, std::optional<double> offset, double overall) {
  ScoredOperation one;
  one.skill = skill;
  one.score.overall = overall;
  procedure::ScoreItem item;
  item.id = "offset_mm";
  item.value = offset;
  one.score.items = {item};
  return one;
}

TEST(Validity, ItemsCountByWhatTheirValueEarns) {
  const std::array operations{operation(Skill::Expert, 0.5, 90), operation(Skill::Expert, 2.0, 80),
                              operation(Skill::Novice, 2.5, 0),
                              operation(Skill::Novice, std::nullopt, 0),
                              operation(Skill::Middle, 1.5, 60)};
  const ProcedureValidity validity = validity_of(one_rule(), operations, 1);
  EXPECT_DOUBLE_EQ(validity.total.auc, 1.0);
  ASSERT_EQ(validity.items.size(), 1U);
  EXPECT_TRUE(validity.items[0].counted);
  EXPECT_DOUBLE_EQ(validity.items[0].separation.auc, 1.0);
  EXPECT_TRUE(validity.cases[0].is_in_order());
  EXPECT_DOUBLE_EQ(validity.cases[0].total[static_cast<std::size_t>(Skill::Expert)], 85.0);
}

TEST(Validity, WhoDoesNotGetSoFarIsToldApartFromWhoDoesItBadly) {
  // Half of the novices reach what is measured, and do it as well as the experts.
  const std::array operations{operation(Skill::Expert, 2.0, 90), operation(Skill::Expert, 2.0, 80),
                              operation(Skill::Middle, 2.0, 50), operation(Skill::Novice, 2.0, 0),
                              operation(Skill::Novice, std::nullopt, 0)};
  const ItemValidity item = validity_of(one_rule(), operations, 1).items[0];
  EXPECT_DOUBLE_EQ(item.separation.auc, 0.75);
  ASSERT_TRUE(item.where_measured.has_value());
  EXPECT_DOUBLE_EQ(item.where_measured->auc, 0.5);
  const ItemMeans& novice = item.means[static_cast<std::size_t>(Skill::Novice)];
  EXPECT_DOUBLE_EQ(novice.measured_share, 0.5);
  EXPECT_DOUBLE_EQ(novice.earned_share, 0.25);
  EXPECT_DOUBLE_EQ(*novice.value, 2.0);
  EXPECT_TRUE(item.is_in_order());
}

TEST(Validity, AMiddleOneBeyondTheExpertIsOutOfOrder) {
  const std::array operations{operation(Skill::Expert, 1.5, 90), operation(Skill::Middle, 0.5, 60),
                              operation(Skill::Novice, 2.5, 0)};
  EXPECT_FALSE(validity_of(one_rule(), operations, 1).items[0].is_in_order());
}

TEST(Validity, SeparatesOnEachCaseByItself) {
  std::array operations{operation(Skill::Expert, 0.5, 90), operation(Skill::Novice, 2.5, 10),
                        operation(Skill::Expert, 0.5, 30), operation(Skill::Novice, 2.5, 60)};
  operations[2].case_index = operations[3].case_index = 1;
  const ProcedureValidity validity = validity_of(one_rule(), operations, 2);
  EXPECT_DOUBLE_EQ(validity.total.auc, 0.75);
  EXPECT_DOUBLE_EQ(validity.cases[0].separation.auc, 1.0);
  EXPECT_DOUBLE_EQ(validity.cases[1].separation.auc, 0.0);
}

TEST(Validity, TellsWhatMadeAFixationUnsafeInTheProceduresOrder) {
  procedure::Procedure procedure = one_rule();
  procedure.rules.safety.resize(3);
  procedure.rules.safety[0].id = "placed";
  procedure.rules.safety[1].id = "covered";
  procedure.rules.safety[2].id = "out";
  std::array operations{operation(Skill::Expert, 0.5, 90), operation(Skill::Novice, 2.5, 0),
                        operation(Skill::Novice, 2.5, 0), operation(Skill::Middle, 1.5, 60)};
  operations[1].score.must_haves = {{"covered", "", true}, {"out", "", false}};
  operations[2].score.must_haves = {{"covered", "", false}, {"out", "", false}};
  const ProcedureValidity validity = validity_of(procedure, operations, 1);
  const std::vector<MissedShare>& missed = validity.cases[0].missed;
  ASSERT_EQ(missed.size(), 2U);
  EXPECT_EQ(missed[0].id, "covered");
  EXPECT_EQ(missed[1].id, "out");
  EXPECT_DOUBLE_EQ(missed[0].share[static_cast<std::size_t>(Skill::Novice)], 0.5);
  EXPECT_DOUBLE_EQ(missed[1].share[static_cast<std::size_t>(Skill::Novice)], 1.0);
  EXPECT_DOUBLE_EQ(missed[1].share[static_cast<std::size_t>(Skill::Expert)], 0.0);
}

}  // namespace
}  // namespace carpus::trainee
