// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/attempt.hpp"

#include <gtest/gtest.h>

#include "simulation/operation_test_support.hpp"
#include "trainee/hand_motion.hpp"

namespace carpus::trainee {
namespace {

using simulation::test::posed_wrist;

const procedure::ScoreItem& item_of(const Attempt& attempt, std::string_view id) {
  for (const auto& item : attempt.score.items) {
    if (item.id == id) return item;
  }
  ADD_FAILURE() << id;
  return attempt.score.items.front();
}

class EverySeed : public testing::TestWithParam<std::uint64_t> {};

TEST_P(EverySeed, BothFinishAndTheExpertScoresBetter) {
  const Attempt expert = operate(posed_wrist(), Skill::Expert, GetParam(), "test");
  const Attempt novice = operate(posed_wrist(), Skill::Novice, GetParam(), "test");
  for (const Attempt* attempt : {&expert, &novice}) {
    EXPECT_TRUE(attempt->last.finished);
    EXPECT_GE(attempt->record.screw_index, 0) << "a screw was inserted";
    EXPECT_LT(attempt->record.ticks, 600000U);
  }
  EXPECT_GT(expert.score.overall, novice.score.overall + 10.0);
  EXPECT_TRUE(expert.score.is_fixation_acceptable);
  EXPECT_GT(expert.score.overall, 85.0);
  EXPECT_EQ(item_of(novice, "required_views_seen").grade, procedure::Grade::Fail);
  for (const Attempt* attempt : {&expert, &novice}) {
    std::string line;
    for (const auto& item : attempt->score.items) {
      line += item.id + "=" + std::to_string(item.value.value_or(-99)) + " ";
    }
    RecordProperty(attempt == &expert ? "expert" : "novice", line);
  }
}

INSTANTIATE_TEST_SUITE_P(TenSeeds, EverySeed, testing::Range<std::uint64_t>(1, 11));

TEST(ScriptedTrainee, SameSeedSameBytesOtherSeedOtherBytes) {
  const Attempt a = operate(posed_wrist(), Skill::Novice, 3, "test");
  const Attempt b = operate(posed_wrist(), Skill::Novice, 3, "test");
  const Attempt c = operate(posed_wrist(), Skill::Novice, 4, "test");
  EXPECT_EQ(simulation::encode(a.recording), simulation::encode(b.recording));
  EXPECT_NE(a.last.state_hash, c.last.state_hash);
}

TEST(ScriptedTrainee, ItsRecordingReplaysToTheSameHash) {
  const Attempt a = operate(posed_wrist(), Skill::Expert, 5, "test");
  const auto decoded = simulation::decode(simulation::encode(a.recording));
  ASSERT_TRUE(decoded.has_value()) << decoded.error();
  EXPECT_TRUE(simulation::replay(posed_wrist(), *decoded).hash_matches);
  EXPECT_EQ(simulation::score_recording(posed_wrist(), *decoded).overall, a.score.overall);
}

TEST(MinimumJerkMove, StartsAndEndsAtRest) {
  const MinimumJerkMove move({{0, 0, 0}, {0, 0, 1}}, {{100, 0, 0}, {0, 1, 0}}, 1000);
  EXPECT_EQ(move.at(0).tip.x, 0.0);
  EXPECT_LT(move.at(1).tip.x, 1e-4);
  EXPECT_NEAR(move.at(500).tip.x, 50.0, 1e-9);
  EXPECT_GT(move.at(999).tip.x, 100.0 - 1e-4);
  EXPECT_EQ(move.at(5000).tip.x, 100.0);
}

TEST(Tremor, HasAboutItsRootMeanSquareAndStaysBounded) {
  Tremor tremor(0.2, Rng(9));
  double sum = 0;
  double most = 0;
  constexpr int kTicks = 200000;
  for (int i = 0; i < kTicks; ++i) {
    const double x = tremor.next().x;
    sum += x * x;
    most = std::max(most, std::abs(x));
  }
  EXPECT_NEAR(std::sqrt(sum / kTicks), 0.2, 0.05);
  EXPECT_LT(most, 1.5);
}

}  // namespace
}  // namespace carpus::trainee
