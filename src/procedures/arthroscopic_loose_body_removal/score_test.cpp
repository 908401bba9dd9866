// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "procedures/arthroscopic_loose_body_removal/declared.hpp"

namespace carpus::procedures::arthroscopic_loose_body_removal {
namespace {

procedure::OperationRecord perfect() {
  procedure::OperationRecord record;
  record.ticks = 180'000;
  record.scope.emplace();
  record.scope->looking_ticks = 150'000;
  record.scope->entries = 1;
  procedure::LooseFacts& done = record.scope->facts.loose;
  done.there = 2;
  done.seen = 2;
  done.out = 2;
  done.closings = done.catches = 2;
  done.seen_since = 0b111110;
  return record;
}

double points(const procedure::OperationRecord& record, const std::string& id) {
  const procedure::ScoreReport report = score(cases::CaseData{}, record);
  const auto at = std::find_if(report.items.begin(), report.items.end(),
                               [&](const auto& item) { return item.id == id; });
  EXPECT_NE(at, report.items.end()) << id;
  return at == report.items.end() ? -1 : at->points;
}

TEST(LooseBodyRemovalScore, AllOutAndLookedForAgainEarnsAll) {
  EXPECT_DOUBLE_EQ(score(cases::CaseData{}, perfect()).overall, 100.0);
}

TEST(LooseBodyRemovalScore, NothingOutHasNoFaultsToBePraisedFor) {
  procedure::OperationRecord record = perfect();
  record.scope->facts.loose = {};
  record.scope->facts.loose.there = 2;
  for (const char* id :
       {"brought_out_share", "lost_from_jaws", "tissue_bitten", "closed_unseen", "looked_again"}) {
    EXPECT_DOUBLE_EQ(points(record, id), 0.0) << id;
  }
}

TEST(LooseBodyRemovalScore, EachFaultCostsWhereItBelongs) {
  const auto after = [](const char* id, auto change) {
    procedure::OperationRecord record = perfect();
    change(record.scope->facts.loose);
    return points(record, id);
  };
  EXPECT_DOUBLE_EQ(after("brought_out_share", [](auto& done) { done.out = 1; }), 0.0)
      << "half of them is none";
  EXPECT_DOUBLE_EQ(after("tissue_bitten", [](auto& done) { done.bites = 3; }), 0.0);
  EXPECT_DOUBLE_EQ(after("closed_unseen", [](auto& done) { done.unseen_closings = 3; }), 0.0);
  EXPECT_LT(after("lost_from_jaws", [](auto& done) { done.slips = 4; }),
            points(perfect(), "lost_from_jaws"));
  EXPECT_DOUBLE_EQ(after("looked_again", [](auto& done) { done.seen_since = 0; }), 0.0);
}

}  // namespace
}  // namespace carpus::procedures::arthroscopic_loose_body_removal
