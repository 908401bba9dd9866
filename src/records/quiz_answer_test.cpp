// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers of the view quiz in the records: found as they were, in a file from before there were any
// too, and none is lost because the file was held for a moment or was repaired.
#include "records/quiz_answer.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>

#include "records/attempt_keeper.hpp"
#include "records/attempt_store.hpp"
#include "records/detail/schema.hpp"
#include "records/records_care.hpp"
#include "records/records_test_support.hpp"

namespace carpus::records {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

QuizAnswer make_answer(const std::string& trainee, std::int64_t question = 1) {
  QuizAnswer answer;
  answer.trainee = trainee;
  answer.case_name = "demo wrist";
  answer.case_fingerprint = "00ff00ff00ff00ff";
  answer.seed = 4'294'967'295;
  answer.question = question;
  answer.answered_at = "2026-01-31T12:00:00.000Z";
  answer.place = "distal";
  answer.depth_mm = 1.25;
  answer.answered = "inside";
  answer.next_view = "skyline";
  answer.is_view_right = true;
  answer.views_taken = 3;
  return answer;
}

TEST(QuizAnswers, AreFoundAsTheyWereNewestFirstInPages) {
  const TemporaryFolder folder;
  {
    AttemptStore store(folder / "attempts.sqlite");
    for (int i = 1; i <= 5; ++i) EXPECT_EQ(store.save(make_answer("Ada", i)), i);
  }
  const AttemptStore store(folder / "attempts.sqlite");
  const QuizAnswerPage newest = store.quiz_page(0, 2);
  ASSERT_EQ(newest.answers.size(), 2U);
  EXPECT_TRUE(newest.older);
  QuizAnswer last = make_answer("Ada", 5);
  last.id = 5;
  EXPECT_EQ(newest.answers.front(), last);
  const QuizAnswerPage older = store.quiz_page(4, 3);
  ASSERT_EQ(older.answers.size(), 3U);
  EXPECT_FALSE(older.older);
  EXPECT_EQ(older.answers.back().id, 1);
  const QuizAnswerPage own = store.quiz_page(0, 10, [](std::int64_t id) { return id % 2 == 0; });
  ASSERT_EQ(own.answers.size(), 2U);
  EXPECT_EQ(own.answers.front().id, 4);
}

TEST(QuizAnswers, GoIntoRecordsFromBeforeThereWereAny) {
  const TemporaryFolder folder;
  {
    SQLite::Database database((folder / "attempts.sqlite").string(),
                              SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    for (std::size_t version = 0; version < 4; ++version) {
      database.exec(detail::kMigrations[version]);
    }
    database.exec(
        "INSERT INTO attempt (id, trainee, case_name, case_fingerprint, procedure, input_device, "
        "started_at, ended_at, outcome, duration_ticks, final_hash, score, events, recording, "
        "mode) "
        "VALUES (7, 'Ada', 'demo wrist', '00ff00ff00ff00ff', 'p', 'mouse', "
        "'2026-01-31T12:00:00.000Z', '2026-01-31T12:05:00.250Z', 'unfinished', 5, "
        "'0123456789abcdef', '', '[]', '', 'practice')");
    database.exec("PRAGMA application_id = " + std::to_string(detail::kApplicationId));
    database.exec("PRAGMA user_version = 4");
  }
  AttemptStore store(folder / "attempts.sqlite");
  EXPECT_EQ(store.find(7)->summary.mode, "practice");
  EXPECT_TRUE(store.quiz_page(0, 10).answers.empty());
  EXPECT_EQ(store.save(make_answer("Ada")), 1);
  EXPECT_EQ(store.quiz_page(0, 10).answers.front().trainee, "Ada");
}

TEST(QuizAnswers, WaitInMemoryWhileTheRecordsRefuse) {
  const TemporaryFolder folder;
  using namespace std::chrono_literals;
  AttemptKeeper keeper(folder / "attempts.sqlite", {}, {20ms, 10min});
  const auto save = [&] {
    auto kept = std::make_shared<std::promise<KeptAttempt>>();
    keeper.save(make_answer("Ada"), [kept](const KeptAttempt& k) { kept->set_value(k); });
    return kept->get_future().get();
  };
  {
    SQLite::Database other((folder / "attempts.sqlite").string(), SQLite::OPEN_READWRITE);
    other.exec("BEGIN IMMEDIATE");
    const KeptAttempt refused = save();
    EXPECT_EQ(refused.id, 0);
    EXPECT_THAT(refused.problem, HasSubstr("kept in memory"));
    EXPECT_EQ(keeper.waiting(), 1U);
    other.exec("ROLLBACK");
  }
  EXPECT_EQ(keeper.settle(), 0U);
  EXPECT_EQ(keeper.quiz_page(0, 10).answers.size(), 1U);
  EXPECT_EQ(save().id, 2);
}

TEST(QuizAnswers, ARepairKeepsThem) {
  const TemporaryFolder folder;
  {
    AttemptStore store(folder / "attempts.sqlite");
    (void)store.save(testing::make_attempt("Ada"));
    for (int i = 1; i <= 3; ++i) (void)store.save(make_answer("Ada", i));
  }
  EXPECT_EQ(repair_records(folder / "attempts.sqlite").saved, 1);
  const auto answers = AttemptStore(folder / "attempts.sqlite").quiz_page(0, 10).answers;
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers.front().question, 3);
}

}  // namespace
}  // namespace carpus::records
