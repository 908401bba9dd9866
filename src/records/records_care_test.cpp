// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/records_care.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "core/error.hpp"
#include "records/attempt_store.hpp"
#include "records/records_test_support.hpp"

namespace carpus::records {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::make_attempt;
using testing::TemporaryFolder;

/// Forty attempts, some pages of which are overwritten.
fs::path damaged_records(const TemporaryFolder& folder) {
  const fs::path file = folder / "attempts.sqlite";
  {
    AttemptStore store(file);
    for (int i = 0; i < 40; ++i) store.save(make_attempt("Ada " + std::to_string(i), 9000));
  }
  for (const std::streamoff page : {20, 33, 47}) {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(page * 4096);
    bytes << std::string(4096, '\xee');
  }
  return file;
}

TEST(RecordsCare, ASoundFileIsFoundSoundWithWhatWaitsBesideIt) {
  const TemporaryFolder folder;
  { AttemptStore(folder / "attempts.sqlite").save(make_attempt("Ada")); }
  std::ofstream(folder / "attempts.running-abc.journal") << "x";
  const RecordsCheck check = check_records(folder / "attempts.sqlite");
  EXPECT_THAT(check.problems, ::testing::IsEmpty());
  EXPECT_EQ(check.attempts, 1);
  ASSERT_EQ(check.waiting.size(), 1U);
}

TEST(RecordsCare, ADamagedFileIsFoundDamagedAndGivesWhatCanBeRead) {
  const TemporaryFolder folder;
  const fs::path file = damaged_records(folder);
  EXPECT_FALSE(check_records(file).problems.empty());
  EXPECT_THROW(AttemptStore{file}, IoError);
  const RecordsRepair repair = repair_records(file);
  EXPECT_GT(repair.saved, 20);
  EXPECT_EQ(repair.saved + static_cast<std::int64_t>(repair.lost.size()), 40);
  EXPECT_TRUE(fs::exists(repair.damaged));
  EXPECT_THAT(check_records(file).problems, ::testing::IsEmpty());
  AttemptStore store(file);
  EXPECT_EQ(static_cast<std::int64_t>(store.list().size()), repair.saved);
  const auto some = store.list().back();
  EXPECT_EQ(some.trainee, "Ada " + std::to_string(some.id - 1)) << "with its number";
  EXPECT_EQ(store.find(some.id)->recording, make_attempt("", 9000).recording);
  EXPECT_EQ(store.save(make_attempt("after")), 41) << "no number comes twice";
}

TEST(RecordsCare, AFileInUseIsNotRepaired) {
  const TemporaryFolder folder;
  const fs::path file = folder / "attempts.sqlite";
  { AttemptStore(file).save(make_attempt("Ada")); }
  SQLite::Database station(file.string(), SQLite::OPEN_READWRITE);
  station.exec("BEGIN IMMEDIATE");
  try {
    (void)repair_records(file);
    FAIL() << "repaired";
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), HasSubstr("stop the station"));
  }
  station.exec("ROLLBACK");
  EXPECT_EQ(AttemptStore(file).list().size(), 1U);
}

TEST(RecordsCare, ACopyIsWholeWhileAStationWrites) {
  const TemporaryFolder folder;
  const fs::path file = folder / "attempts.sqlite";
  AttemptStore store(file);
  for (int i = 0; i < 20; ++i) store.save(make_attempt("Ada", 20000));
  std::atomic<bool> stop = false;
  std::thread station([&] {
    AttemptStore writing(file);
    while (!stop) writing.save(make_attempt("Grace", 20000));
  });
  for (int i = 0; i < 5; ++i) {
    const std::int64_t copied = back_up_records(file, folder / "copy.sqlite");
    EXPECT_GE(copied, 20);
    EXPECT_FALSE(fs::exists(folder / "copy.sqlite-wal"));
    const RecordsCheck check = check_records(folder / "copy.sqlite");
    EXPECT_THAT(check.problems, ::testing::IsEmpty());
    EXPECT_EQ(check.attempts, copied);
  }
  stop = true;
  station.join();
}

}  // namespace
}  // namespace carpus::records
