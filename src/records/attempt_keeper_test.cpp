// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/attempt_keeper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "records/records_test_support.hpp"

namespace carpus::records {
namespace {

using testing::FileSizeLimit;
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
  EXPECT_EQ(keeper.waiting(), 0U);
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
    EXPECT_TRUE(rescued_files(folder).empty());
  }
  (void)keeper.save(make_attempt("Grace"));
  const auto attempts = keeper.list();
  ASSERT_EQ(attempts.size(), 2U);
  EXPECT_EQ(keeper.find(attempts[0].id)->recording, make_attempt("Ada", 200000).recording);
}

}  // namespace
}  // namespace carpus::records
