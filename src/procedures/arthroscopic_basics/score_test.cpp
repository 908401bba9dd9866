// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "procedures/arthroscopic_basics/declared.hpp"

namespace carpus::procedures::arthroscopic_basics {
namespace {

procedure::OperationRecord perfect() {
  procedure::OperationRecord record;
  record.ticks = 120'000;
  record.scope.emplace();
  record.scope->looking_ticks = 100'000;
  record.scope->entries = 1;
  procedure::DrillFacts& done = record.scope->facts.drill;
  done.held = 3;
  done.round_most = 5;
  done.is_round_done = true;
  done.touched = 5;
  done.are_touches_done = true;
  done.line_share = 1;
  done.is_line_done = true;
  done.seen_path_mm = 80;
  done.unseen_path_mm = 20;
  return record;
}

procedure::ScoreReport scored(const procedure::OperationRecord& record) {
  return score(cases::CaseData{}, record);
}

double points(const procedure::ScoreReport& report, const std::string& id) {
  const auto at = std::find_if(report.items.begin(), report.items.end(),
                               [&](const auto& item) { return item.id == id; });
  EXPECT_NE(at, report.items.end()) << id;
  return at == report.items.end() ? -1 : at->points;
}

TEST(ArthroscopicBasicsScore, AllDoneEarnsAll) {
  EXPECT_DOUBLE_EQ(scored(perfect()).overall, 100.0);
}

TEST(ArthroscopicBasicsScore, NothingDoneHasNoFaultsToBePraisedFor) {
  procedure::OperationRecord record = perfect();
  record.scope->facts.drill = {};
  const procedure::ScoreReport report = scored(record);
  for (const char* id : {"held_share", "hold_breaks", "seen_from_one_place", "touched_share",
                         "wrong_touches", "line_share", "line_breaks", "probe_unseen_share"}) {
    EXPECT_DOUBLE_EQ(points(report, id), 0.0) << id;
  }
}

TEST(ArthroscopicBasicsScore, EachFaultCostsWhereItBelongs) {
  const auto after = [](const char* id, auto change) {
    procedure::OperationRecord record = perfect();
    change(record.scope->facts.drill);
    return points(scored(record), id);
  };
  const procedure::ScoreReport best = scored(perfect());
  EXPECT_LT(after("hold_breaks", [](auto& done) { done.hold_breaks = 6; }),
            points(best, "hold_breaks"));
  EXPECT_DOUBLE_EQ(after("wrong_touches", [](auto& done) { done.wrong_touches = 4; }), 0.0);
  EXPECT_DOUBLE_EQ(after("line_breaks", [](auto& done) { done.line_breaks = 6; }), 0.0);
  EXPECT_DOUBLE_EQ(after("probe_unseen_share", [](auto& done) { done.unseen_path_mm = 400; }), 0.0);
  EXPECT_LT(after("touched_share", [](auto& done) { done.touched = 2; }),
            points(best, "touched_share"));
}

TEST(ArthroscopicBasicsScore, AScopeThatWasHardlyInEarnsNothing) {
  procedure::OperationRecord record = perfect();
  record.scope->looking_ticks = 9'000;
  EXPECT_DOUBLE_EQ(scored(record).overall, 0.0);
}

}  // namespace
}  // namespace carpus::procedures::arthroscopic_basics
