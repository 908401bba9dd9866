// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "procedure/situation.hpp"
#include "procedures/arthroscopic_portal_making/declared.hpp"
#include "procedures/arthroscopy_from_the_skin/declared.hpp"

namespace carpus::procedures::arthroscopy_from_the_skin {
namespace {

procedure::ScoreItem needle_seen(std::uint8_t made, std::uint32_t ticks) {
  procedure::OperationRecord record;
  procedure::MakingFacts& facts = record.making.emplace();
  facts.made = made;
  facts.portal[1].needle_seen_ticks = ticks;
  procedure::ScopeRecord& scope = record.scope.emplace();  // as the must-haves want it
  scope.looking_ticks = 60'000;
  scope.entries = 1;
  const procedure::ScoreReport report = declared().score(cases::CaseData{}, record);
  const auto at = std::find_if(report.items.begin(), report.items.end(),
                               [](const auto& item) { return item.id == "second_needle_seen_s"; });
  EXPECT_NE(at, report.items.end());
  return at == report.items.end() ? procedure::ScoreItem{} : *at;
}

TEST(FromTheSkinScore, ANeedleSeenForASecondEarnsAll) {
  const procedure::ScoreItem whole = needle_seen(2, procedure::kNeedleSeenTicks);
  EXPECT_DOUBLE_EQ(whole.points, whole.points_possible);
  EXPECT_GT(whole.points, 0.0);
  EXPECT_DOUBLE_EQ(needle_seen(2, 9 * procedure::kNeedleSeenTicks).points, whole.points);
}

TEST(FromTheSkinScore, AGlimpseOfItEarnsLessAndNoneNothing) {
  const procedure::ScoreItem glimpse = needle_seen(2, procedure::kNeedleSeenTicks / 4);
  EXPECT_LT(glimpse.points, glimpse.points_possible / 2);
  EXPECT_GT(glimpse.points, 0.0);
  EXPECT_DOUBLE_EQ(needle_seen(2, 0).points, 0.0);
  EXPECT_NE(needle_seen(2, 0).reason.find("never"), std::string::npos);
}

TEST(FromTheSkinScore, ANeedleThatWasLookedAtAndLedToNoPortalEarnsNothing) {
  EXPECT_FALSE(needle_seen(1, 5 * procedure::kNeedleSeenTicks).value);
}

TEST(FromTheSkinScore, TheStepIsDoneByASecondInSightAndNotByANeedleInTheJoint) {
  const auto& steps = declared().steps;
  const auto step = std::find_if(steps.begin(), steps.end(),
                                 [](const auto& each) { return each.id == "needle_2"; });
  ASSERT_NE(step, steps.end());
  procedure::Situation now;
  now.making.portal[1].needle.is_in = true;
  now.making.portal[1].needle_seen_ticks = procedure::kNeedleSeenTicks - 1;
  EXPECT_FALSE(step->is_done(now));
  now.making.portal[1].needle_seen_ticks = procedure::kNeedleSeenTicks;
  EXPECT_TRUE(step->is_done(now));
}

TEST(FromTheSkinScore, WhatWasLeftOutBeforeACutOrAPortalThatIsMadeIsAskedForNoMore) {
  const auto passes = [](const procedure::Procedure& procedure) {
    std::vector<std::string> ids;
    for (const auto& step : procedure.steps) {
      if (step.passes_over_earlier) ids.push_back(step.id);
    }
    return ids;
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(passes(arthroscopic_portal_making::declared()), (Ids{"sheath", "sheath_2"}));
  // After the cut no needle is seen before it.
  EXPECT_EQ(passes(declared()), (Ids{"sheath", "incise_2", "sheath_2"}));
}

TEST(FromTheSkinScore, TheScopeGoesInBeforeTheSecondPortalIsFeltFor) {
  const auto& steps = declared().steps;
  const auto place = [&](const char* id) {
    return std::find_if(steps.begin(), steps.end(),
                        [&](const auto& each) { return each.id == id; }) -
           steps.begin();
  };
  EXPECT_LT(place("sheath"), place("look_in"));
  EXPECT_LT(place("look_in"), place("palpate_2"));
  EXPECT_LT(place("needle_2"), place("incise_2"));
}

}  // namespace
}  // namespace carpus::procedures::arthroscopy_from_the_skin
