// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/attempt_keeper.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "records/records_test_support.hpp"
#include "records/rescue_file.hpp"

namespace carpus::records {
namespace {

using testing::FileSizeLimit;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using testing::make_attempt;
using testing::TemporaryFolder;

std::vector<std::filesystem::path> rescued_files(const TemporaryFolder& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string name = entry.path().filename().string();
    if (name.find("rescued") != std::string::npos && name.ends_with(".sqlite")) {
      files.push_back(entry.path());
    }
  }
  return files;
}

TEST(AttemptKeeper, AttemptThatTheRecordsRefuseGoesToAFileOfItsOwn) {
  const TemporaryFolder folder;
  AttemptKeeper keeper(folder / "attempts.sqlite");
  keeper.store().limit_pages(8);
  const Attempt attempt = make_attempt("Ada", 200000);
  const KeptAttempt kept = keeper.save(attempt);
  EXPECT_EQ(kept.id, 0);
  EXPECT_THAT(kept.problem, HasSubstr("free some space"));
  const auto files = rescued_files(folder);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_THAT(kept.problem, HasSubstr(files[0].string()));
  EXPECT_TRUE(kept.is_on_disk);
  const auto rescued = AttemptStore(files[0]).find(1);
  ASSERT_TRUE(rescued.has_value());
  EXPECT_EQ(rescued->recording, attempt.recording);
}

TEST(AttemptKeeper, WaitingAttemptsAreStoredWithTheNextThatSucceeds) {
  const TemporaryFolder folder;
  AttemptKeeper keeper(folder / "attempts.sqlite");
  keeper.store().limit_pages(8);
  (void)keeper.save(make_attempt("Ada", 200000));
  EXPECT_EQ(keeper.waiting(), 1U);
  keeper.store().limit_pages(100000);
  const KeptAttempt kept = keeper.save(make_attempt("Grace"));
  EXPECT_TRUE(kept.problem.empty()) << kept.problem;
  EXPECT_EQ(keeper.settle(), 0U);
  EXPECT_EQ(keeper.list().size(), 2U);
  EXPECT_TRUE(rescued_files(folder).empty());
}

TEST(AttemptKeeper, KeepsTheAttemptInMemoryWhileNothingCanBeWritten) {
  const TemporaryFolder folder;
  AttemptKeeper keeper(folder / "attempts.sqlite");
  {
    const FileSizeLimit nothing_grows(20000);
    const KeptAttempt kept = keeper.save(make_attempt("Ada", 200000));
    EXPECT_EQ(kept.id, 0);
    EXPECT_THAT(kept.problem, HasSubstr("kept in memory"));
    EXPECT_FALSE(kept.is_on_disk);
    EXPECT_TRUE(rescued_files(folder).empty());
  }
  (void)keeper.save(make_attempt("Grace"));
  const auto attempts = keeper.list();
  ASSERT_EQ(attempts.size(), 2U);
  EXPECT_EQ(keeper.find(attempts[0].id)->recording, make_attempt("Ada", 200000).recording);
}

TEST(AttemptKeeper, WhatWaitsIsTriedAgainAtTheEnd) {
  const TemporaryFolder folder;
  {
    AttemptKeeper keeper(folder / "attempts.sqlite");
    keeper.store().limit_pages(8);
    (void)keeper.save(make_attempt("Ada", 200000));
    keeper.store().limit_pages(100000);
  }
  EXPECT_EQ(AttemptStore(folder / "attempts.sqlite").list().size(), 1U);
  EXPECT_TRUE(rescued_files(folder).empty());
}

TEST(AttemptKeeper, WhatWasRescuedBeforeIsTakenBackAtTheStartAndOnlyOnce) {
  const TemporaryFolder folder;
  std::filesystem::path rescued;
  {
    AttemptStore full(folder / "attempts.sqlite");
    rescued = rescue(full.file(), make_attempt("Ada"));
    ASSERT_TRUE(std::filesystem::exists(rescued));
  }
  std::filesystem::copy(rescued, folder / "copy");
  std::vector<std::string> words;
  {
    AttemptKeeper keeper(folder / "attempts.sqlite",
                         [&](const auto& line) { words.push_back(line); });
    EXPECT_EQ(keeper.settle(), 0U);
    EXPECT_EQ(keeper.list().size(), 1U);
    EXPECT_TRUE(rescued_files(folder).empty());
    // As if the program had been killed between storing and deleting.
    std::filesystem::rename(folder / "copy", rescued);
    EXPECT_EQ(keeper.settle(), 0U);
    EXPECT_EQ(keeper.list().size(), 1U);
  }
  EXPECT_TRUE(rescued_files(folder).empty());
  ASSERT_FALSE(words.empty());
  EXPECT_THAT(words[0], HasSubstr("stored as attempt 1"));
}

TEST(AttemptKeeper, AForeignLockHoldsUpNobodyAndLosesNothing) {
  const TemporaryFolder folder;
  AttemptKeeper keeper(folder / "attempts.sqlite", {}, {3s, 50ms});
  (void)keeper.save(make_attempt("before"));
  SQLite::Database foreign((folder / "attempts.sqlite").string(), SQLite::OPEN_READWRITE);
  foreign.exec("BEGIN EXCLUSIVE");
  std::promise<KeptAttempt> kept;
  std::future<KeptAttempt> told = kept.get_future();
  keeper.save(make_attempt("Ada"), [&](const KeptAttempt& answer) { kept.set_value(answer); });
  EXPECT_EQ(keeper.list().size(), 1U);
  EXPECT_EQ(told.wait_for(0s), std::future_status::timeout) << "neither saving nor listing waits";
  const KeptAttempt answer = told.get();
  EXPECT_TRUE(answer.is_on_disk);
  EXPECT_THAT(answer.problem, HasSubstr("another program"));
  foreign.exec("ROLLBACK");
  for (int i = 0; i < 200 && keeper.waiting() > 0; ++i) std::this_thread::sleep_for(20ms);
  EXPECT_EQ(keeper.list().size(), 2U) << "by itself";
  EXPECT_TRUE(rescued_files(folder).empty());
}

TEST(AttemptKeeper, RefusesWithAWordWhatItCannotHold) {
  const TemporaryFolder folder;
  AttemptKeeper keeper(folder / "attempts.sqlite", {}, {0ms, 60s});
  const FileSizeLimit nothing_grows(20000);
  KeptAttempt last;
  for (std::size_t i = 0; i <= AttemptKeeper::kMostWaiting; ++i) {
    last = keeper.save(make_attempt("Ada", 100000));
  }
  EXPECT_EQ(keeper.waiting(), AttemptKeeper::kMostWaiting);
  EXPECT_FALSE(last.is_on_disk);
  EXPECT_THAT(last.problem, HasSubstr("was not taken"));
}

}  // namespace
}  // namespace carpus::records
