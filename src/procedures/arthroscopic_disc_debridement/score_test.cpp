// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "procedures/arthroscopic_disc_debridement/declared.hpp"

namespace carpus::procedures::arthroscopic_disc_debridement {
namespace {

procedure::OperationRecord perfect() {
  procedure::OperationRecord record;
  record.ticks = 240'000;
  record.scope.emplace();
  record.scope->looking_ticks = 200'000;
  record.scope->entries = 1;
  record.scope->fluid.watched_ticks = 150'000;
  procedure::ShavingFacts& done = record.scope->facts.shaving;
  done.ill = done.ill_removed = 20;
  done.sound = 80;
  done.patches = 1;
  done.patches_seen = 1;
  done.running_ticks = 30'000;
  done.ticks_since_cut = 20'000;
  done.seen_since = 0b111110;
  record.scope->facts.punch.bites = 6;
  return record;
}

procedure::ScoreReport score(const procedure::OperationRecord& record) {
  return declared().score(cases::CaseData{}, record);
}

double points(const procedure::OperationRecord& record, const std::string& id) {
  const procedure::ScoreReport report = score(record);
  const auto at = std::find_if(report.items.begin(), report.items.end(),
                               [&](const auto& item) { return item.id == id; });
  EXPECT_NE(at, report.items.end()) << id;
  return at == report.items.end() ? -1 : at->points;
}

TEST(DebridementScore, AllLooseEdgesTrimmedAndTheRimKeptEarnsAll) {
  EXPECT_DOUBLE_EQ(score(perfect()).overall, 100.0);
}

TEST(DebridementScore, NothingRemovedHasNoFaultsToBePraisedFor) {
  procedure::OperationRecord record = perfect();
  procedure::ShavingFacts& done = record.scope->facts.shaving;
  done.ill_removed = 0;
  done.running_ticks = done.ticks_since_cut = 0;
  done.seen_since = 0;
  for (const char* id :
       {"ill_removed_share", "sound_removed_share", "rim_removed", "ran_unseen_share",
        "ran_on_cartilage_s", "ran_on_lining_s", "ran_against_scope_s", "ran_in_the_way_s",
        "looked_again", "bitten_unseen", "bitten_empty", "bitten_cartilage", "bitten_lining"}) {
    EXPECT_DOUBLE_EQ(points(record, id), 0.0) << id;
  }
}

TEST(DebridementScore, EachFaultCostsWhereItBelongsAndNowhereElse) {
  const auto after = [](const char* id, auto change) {
    procedure::OperationRecord record = perfect();
    change(record.scope->facts.shaving);
    const procedure::ScoreReport whole = score(perfect());
    const procedure::ScoreReport report = score(record);
    for (std::size_t i = 0; i < report.items.size(); ++i) {
      if (report.items[i].id == id) continue;
      EXPECT_DOUBLE_EQ(report.items[i].points, whole.items[i].points) << report.items[i].id;
    }
    return points(record, id);
  };
  EXPECT_DOUBLE_EQ(after("ill_removed_share", [](auto& done) { done.ill_removed = 10; }), 0.0)
      << "half of it is none";
  EXPECT_LT(after("ill_removed_share", [](auto& done) { done.ill_removed = 10 * 3 / 2; }),
            points(perfect(), "ill_removed_share"));
  EXPECT_DOUBLE_EQ(after("sound_removed_share", [](auto& done) { done.sound_removed = 20; }), 0.0);
  EXPECT_DOUBLE_EQ(after("rim_removed", [](auto& done) { done.rim_removed = 6; }), 0.0);
  EXPECT_LT(after("rim_removed", [](auto& done) { done.rim_removed = 1; }),
            points(perfect(), "rim_removed"))
      << "each place counts";
  EXPECT_DOUBLE_EQ(after("ran_unseen_share", [](auto& done) { done.unseen_ticks = 12'000; }), 0.0)
      << "two fifths of the time";
  EXPECT_DOUBLE_EQ(after("ran_on_cartilage_s", [](auto& done) { done.cartilage_ticks = 5'000; }),
                   0.0);
  EXPECT_DOUBLE_EQ(after("ran_on_lining_s", [](auto& done) { done.lining_ticks = 12'000; }), 0.0);
  EXPECT_DOUBLE_EQ(after("ran_against_scope_s", [](auto& done) { done.scope_ticks = 2'000; }), 0.0);
  EXPECT_DOUBLE_EQ(after("ran_in_the_way_s", [](auto& done) { done.way_ticks = 2'000; }), 0.0);
  EXPECT_DOUBLE_EQ(after("looked_again", [](auto& done) { done.seen_since = 0; }), 0.0);
}

/// Of the perfect record's points what a fault of the punch leaves of the whole score.
double overall_after(void (*change)(procedure::PunchFacts&)) {
  procedure::OperationRecord record = perfect();
  change(record.scope->facts.punch);
  return score(record).overall;
}

TEST(DebridementScore, ABiteThatIsBlindOrOfWhatIsToStayCostsAndCostsNothingElse) {
  const auto after = [](const char* id, auto change) {
    procedure::OperationRecord record = perfect();
    change(record.scope->facts.punch);
    const procedure::ScoreReport whole = score(perfect());
    const procedure::ScoreReport report = score(record);
    for (std::size_t i = 0; i < report.items.size(); ++i) {
      if (report.items[i].id == id) continue;
      EXPECT_DOUBLE_EQ(report.items[i].points, whole.items[i].points) << report.items[i].id;
    }
    return points(record, id);
  };
  EXPECT_DOUBLE_EQ(after("bitten_unseen", [](auto& done) { done.unseen = 4; }), 0.0);
  EXPECT_LT(after("bitten_unseen", [](auto& done) { done.unseen = 1; }),
            points(perfect(), "bitten_unseen"))
      << "each one";
  EXPECT_DOUBLE_EQ(after("bitten_empty", [](auto& done) { done.empty = 2; }),
                   points(perfect(), "bitten_empty"))
      << "two are forgiven";
  EXPECT_DOUBLE_EQ(after("bitten_empty", [](auto& done) { done.empty = 10; }), 0.0);
  EXPECT_DOUBLE_EQ(after("bitten_cartilage", [](auto& done) { done.cartilage = 3; }), 0.0);
  EXPECT_DOUBLE_EQ(after("bitten_lining", [](auto& done) { done.lining = 4; }), 0.0);
  EXPECT_LT(overall_after([](auto& done) { done.cartilage = 1; }),
            overall_after([](auto& done) { done.lining = 1; }))
      << "cartilage before all";
}

TEST(DebridementScore, WhoTakesAllOfItWithOneOfTheTwoIsNotFinedForTheOther) {
  procedure::OperationRecord record = perfect();
  record.scope->facts.shaving.running_ticks = 0;
  EXPECT_DOUBLE_EQ(score(record).overall, 100.0) << "bitten off";
  record = perfect();
  record.scope->facts.punch = {};
  EXPECT_DOUBLE_EQ(score(record).overall, 100.0) << "shaved off";
}

}  // namespace
}  // namespace carpus::procedures::arthroscopic_disc_debridement
