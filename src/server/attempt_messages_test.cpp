// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/attempt_messages.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace carpus::server {
namespace {

std::string fixture(const std::string& name) {
  std::ifstream file("protocol/fixtures/valid/stored/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(AttemptMessage, HoldsScoreAndLogAsTheyWereStored) {
  records::Attempt attempt;
  attempt.summary.duration_ticks = 61500;
  attempt.summary.outcome = records::Outcome::Finished;
  attempt.score_json = fixture("stored_score_from_records.json");
  attempt.events_json = R"([{"tick":5,"kind":"touched_bone","text":"Touched the scaphoid"}])";
  const protocol::Attempt message = attempt_message(attempt, "", {});
  EXPECT_EQ(message.duration_s, 61.5);
  EXPECT_EQ(message.outcome, protocol::Outcome::Finished);
  ASSERT_TRUE(message.score.has_value());
  EXPECT_EQ(message.score->items.at(0).id, "angle_to_central_axis_deg");
  ASSERT_TRUE(message.events.has_value());
  EXPECT_EQ(message.events->at(0),
            (protocol::LoggedEvent{5, "touched_bone", "Touched the scaphoid"}));
}

TEST(AttemptMessage, OfALockedAttemptTellsNoMoreThanWhileItRan) {
  records::Attempt attempt;
  attempt.summary.mode = "assessed";
  attempt.summary.outcome = records::Outcome::Unfinished;
  attempt.events_json = R"([{"tick":5,"kind":"touched_bone","text":"Touched the scaphoid"},)"
                        R"({"tick":6,"kind":"wrong_bone","text":"The capitate was entered"},)"
                        R"({"tick":7,"kind":"shot_taken","text":"Shot 1"}])";
  const protocol::Attempt locked = attempt_message(attempt, "", {});
  ASSERT_EQ(locked.events->size(), 2U);
  EXPECT_EQ(locked.events->at(0), (protocol::LoggedEvent{5, "touched_bone", "Touches bone"}));
  EXPECT_EQ(locked.events->at(1), (protocol::LoggedEvent{7, "shot_taken", "Shot 1"}));
  attempt.summary.mode = "practice";
  EXPECT_EQ(attempt_message(attempt, "", {}).events->size(), 3U);
}

TEST(AttemptMessage, LeavesOutWhatCannotBeReadAndKeepsTheRest) {
  records::Attempt attempt;
  attempt.summary.id = 3;
  attempt.score_json = R"({"overall":87.25})";
  attempt.events_json = R"([{"tick":5)";
  const protocol::Attempt message = attempt_message(attempt, "", {});
  EXPECT_EQ(message.id, 3);
  EXPECT_EQ(message.score, std::nullopt);
  EXPECT_EQ(message.events, std::nullopt);
}

TEST(AttemptList, IsReadableWhateverNamesArePutIntoTheRecords) {
  records::AttemptSummary summary;
  summary.trainee = std::string(500, 'x') + "\x02\xFF";
  const auto read =
      protocol::parse_attempt_list(serialize(attempt_list({{summary, {}}, false, 2})));
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(read->attempts.at(0).trainee, std::string(63, 'x') + "…");
  EXPECT_EQ(read->attempts.at(1).case_simulated, std::nullopt);
}

}  // namespace
}  // namespace carpus::server
