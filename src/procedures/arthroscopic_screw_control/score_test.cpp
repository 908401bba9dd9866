// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "arthroscopy/screw_table.hpp"
#include "procedures/arthroscopic_screw_control/declared.hpp"

namespace carpus::procedures::arthroscopic_screw_control {
namespace {

using Answers = std::array<std::uint8_t, 4>;  // end, scaphocapitate, STT, decision

constexpr Answers kWell{0, 0, 0, 0};
constexpr Answers kProudEnd{2, 0, 0, 1};
constexpr std::uint8_t kAll = 0b1111;

/// Looked round for a minute, all places felt.
procedure::OperationRecord record_of(const Answers& truth,
                                     const Answers& said,
                                     std::uint8_t seen_before = kAll,
                                     std::uint8_t probed_before = kAll) {
  procedure::OperationRecord record;
  record.finished = true;
  record.scope.emplace();
  record.scope->looking_ticks = 60'000;
  record.scope->entries = 1;
  for (std::size_t f = 0; f < truth.size(); ++f) {
    record.scope->truth[f] = truth[f];
    record.scope->answers[f] = said[f];
  }
  procedure::ScrewFacts& screw = record.scope->facts.screw;
  screw.seen = screw.probed = 0b111;
  screw.answered_seen = seen_before;
  screw.answered_probed = probed_before;
  screw.sites_at_decision = seen_before & 0b111U;
  return record;
}

struct Judged {
  std::optional<double> value;
  double points = 0;
  double possible = 0;
  std::string reason;
  bool is_there = false;
};

Judged item(const procedure::OperationRecord& record, const std::string& id) {
  for (const procedure::ScoreItem& each : score({}, record).items) {
    if (each.id == id) {
      return {each.value, each.points, each.points_possible, each.reason, true};
    }
  }
  return {};
}

TEST(ScrewControlScore, AllRightAfterLookingEarnsAll) {
  for (const Answers& truth : {kWell, kProudEnd, Answers{0, 1, 0, 2}, Answers{1, 0, 1, 2}}) {
    const auto record = record_of(truth, truth);
    for (const char* id : {"sites_right", "proud_invented", "decision_right", "screw_probed"}) {
      const Judged judged = item(record, id);
      EXPECT_DOUBLE_EQ(judged.points, judged.possible) << id;
      EXPECT_GT(judged.possible, 0) << id;
    }
  }
}

TEST(ScrewControlScore, ARightGuessEarnsNothing) {
  const auto record = record_of(kProudEnd, kProudEnd, 0, 0);
  EXPECT_EQ(item(record, "sites_right").value, 0);
  EXPECT_EQ(item(record, "proud_missed").value, 1) << "said, not found";
  EXPECT_EQ(item(record, "decision_right").value, 0);
  EXPECT_EQ(item(record, "answers_unseen").value, 3);
}

TEST(ScrewControlScore, AnEndJudgedByTheEyeAloneCountsHalf) {
  const auto record = record_of(kWell, kWell, kAll, 0b0110);
  EXPECT_NEAR(*item(record, "sites_right").value, 100 * 2.5 / 3, 1e-9);
}

TEST(ScrewControlScore, WhatIsMissedInventedOrDecidedWronglyIsNamed) {
  const auto missed = record_of(kProudEnd, kWell);
  EXPECT_EQ(item(missed, "proud_missed").value, 1);
  EXPECT_EQ(item(missed, "proud_missed").points, 0);
  EXPECT_EQ(item(missed, "decision_right").value, 0);
  EXPECT_NE(item(missed, "decision_right").reason.find("turn it in deeper"), std::string::npos);
  EXPECT_NE(item(missed, "sites_right").reason.find("buried instead of proud"), std::string::npos);
  const auto invented = record_of(kWell, {0, 1, 0, 2});
  EXPECT_EQ(item(invented, "proud_invented").value, 1);
  EXPECT_FALSE(item(invented, "proud_missed").is_there) << "nothing stands out";
  // Buried for flush is wrong, and nothing is missed by it.
  const auto flush = record_of({1, 0, 0, 0}, kWell);
  EXPECT_NEAR(*item(flush, "sites_right").value, 100 * 2.0 / 3, 1e-9);
  EXPECT_EQ(item(flush, "proud_invented").value, 0);
}

TEST(ScrewControlScore, ADecisionBeforeEverythingWasSeenCountsByWhatWas) {
  const auto record = record_of(kProudEnd, kProudEnd, 0b001);
  EXPECT_NEAR(*item(record, "decision_right").value, 100.0 / 3, 1e-9);
}

TEST(ScrewControlScore, WhoSaysNothingEarnsNothingByIt) {
  auto record = record_of(kWell, kWell, 0, 0);
  record.scope->answers = cases::not_judged();
  record.scope->facts.unanswered = 4;
  for (const char* id : {"sites_right", "proud_invented", "decision_right"}) {
    EXPECT_EQ(item(record, id).points, 0) << id;
  }
  double possible = 0;
  for (const auto& each : score({}, record).items) possible += each.points_possible;
  EXPECT_NEAR(possible, 100, 1e-9);
}

TEST(ScrewControlScore, WhoNeverWentInProvedNoCare) {
  auto record = record_of(kWell, kWell);
  EXPECT_GT(item(record, "pull_outs").points, 0);
  EXPECT_GT(item(record, "force_over_8_n_s").points, 0);
  record.scope->entries = 0;
  record.scope->looking_ticks = 0;
  for (const char* id : {"pull_outs", "force_over_3_n_s", "force_over_8_n_s"}) {
    const Judged judged = item(record, id);
    EXPECT_FALSE(judged.value.has_value()) << id;
    EXPECT_EQ(judged.points, 0) << id;
    EXPECT_GT(judged.possible, 0) << id;
  }
}

}  // namespace
}  // namespace carpus::procedures::arthroscopic_screw_control
