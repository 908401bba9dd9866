// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/attempt_store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "records/detail/schema.hpp"
#include "records/records_test_support.hpp"

namespace carpus::records {
namespace {

using testing::FileSizeLimit;
using ::testing::HasSubstr;
using testing::make_attempt;
using testing::TemporaryFolder;

template <typename Exception, typename Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(AttemptStore, FindsWhatWasSavedByteForByte) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  Attempt attempt = make_attempt("Éva \"O'Neil\"; DROP TABLE attempt;--", 70000);
  attempt.summary.id = store.save(attempt);
  EXPECT_EQ(attempt.summary.id, 1);
  EXPECT_EQ(store.find(1), attempt);
  EXPECT_EQ(store.find(2), std::nullopt);
}

TEST(AttemptStore, KeepsAnUnfinishedAttemptWithoutScoreOrRecording) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  Attempt attempt = make_attempt("", 0);
  attempt.summary.outcome = Outcome::Unfinished;
  attempt.summary.overall.reset();
  attempt.score_json.clear();
  attempt.summary.id = store.save(attempt);
  EXPECT_EQ(store.find(attempt.summary.id), attempt);
}

TEST(AttemptStore, ListsNewestFirstAndSurvivesReopening) {
  const TemporaryFolder folder;
  for (const char* name : {"first", "second", "third"}) {
    AttemptStore store(folder / "attempts.sqlite");
    store.save(make_attempt(name));
  }
  const auto attempts = AttemptStore(folder / "attempts.sqlite").list();
  ASSERT_EQ(attempts.size(), 3U);
  EXPECT_EQ(attempts[0].trainee, "third");
  EXPECT_EQ(attempts[2].trainee, "first");
}

TEST(AttemptStore, ListsInPagesNewestFirst) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  EXPECT_TRUE(store.page(0, 3).attempts.empty());
  for (int i = 0; i < 7; ++i) store.save(make_attempt("Ada", 1));
  std::vector<std::int64_t> ids;
  AttemptPage page = store.page(0, 3);
  EXPECT_EQ(page.total, 7);
  for (int pages = 1;; ++pages) {
    for (const AttemptSummary& each : page.attempts) ids.push_back(each.id);
    EXPECT_EQ(page.older, pages < 3);
    if (!page.older) break;
    page = store.page(ids.back(), 3);
  }
  EXPECT_EQ(ids, (std::vector<std::int64_t>{7, 6, 5, 4, 3, 2, 1}));
  EXPECT_TRUE(store.page(1, 3).attempts.empty());
}

TEST(AttemptStore, StoresAnAttemptOfOneOriginOnce) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  Attempt attempt = make_attempt("Ada");
  attempt.summary.origin = "0123456789abcdef0123456789abcdef";
  EXPECT_FALSE(store.holds(attempt.summary.origin));
  const std::int64_t id = store.save(attempt);
  EXPECT_TRUE(store.holds(attempt.summary.origin));
  EXPECT_EQ(store.save(attempt), id);
  EXPECT_EQ(store.list().size(), 1U);
  EXPECT_EQ(store.find(id)->summary.origin, attempt.summary.origin);
  EXPECT_NE(store.save(make_attempt("Ada")), store.save(make_attempt("Ada"))) << "none noted";
}

/// While it lives, this process is an ordinary user, for whom permissions count.
class OrdinaryUser {
 public:
  OrdinaryUser() {
    if (::geteuid() == 0) is_one_ = ::seteuid(65534) == 0;
  }
  ~OrdinaryUser() {
    if (is_one_ && ::seteuid(0) != 0) std::abort();
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  bool is_one_ = false;
};

TEST(AttemptStore, KnowsAtTheStartThatAFileIsReadOnly) {
  const TemporaryFolder folder;
  { AttemptStore(folder / "attempts.sqlite").save(make_attempt("Ada")); }
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  std::filesystem::permissions(folder / "attempts.sqlite", std::filesystem::perms(0444));
  std::string message;
  {
    const OrdinaryUser user;
    message = message_of<IoError>([&] { AttemptStore(folder / "attempts.sqlite"); });
  }
  EXPECT_THAT(message, HasSubstr("--records"));
  EXPECT_THAT(message, ::testing::AnyOf(HasSubstr("read-only"), HasSubstr("writable")));
}

TEST(AttemptStore, KnowsAtTheStartThatAFileIsDamaged) {
  const TemporaryFolder folder;
  const auto file = folder / "attempts.sqlite";
  {
    AttemptStore store(file);
    for (int i = 0; i < 40; ++i) store.save(make_attempt("Ada", 3000));
  }
  for (const std::streamoff page : {2, 3, 4, 5, 9}) {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(page * 4096);
    bytes << std::string(600, '\xee');
  }
  const std::string message = message_of<IoError>([&] { AttemptStore store(file); });
  EXPECT_THAT(message, HasSubstr("damaged; 'carpus attempts --repair'"));
}

TEST(AttemptStore, TwoProcessesMaySaveInTurn) {
  const TemporaryFolder folder;
  AttemptStore one(folder / "attempts.sqlite");
  AttemptStore other(folder / "attempts.sqlite");
  one.save(make_attempt("one"));
  other.save(make_attempt("other"));
  one.save(make_attempt("one again"));
  EXPECT_EQ(other.list().size(), 3U);
}

TEST(AttemptStore, FullDiskStoresNothingOfTheAttemptAndSaysWhatToDo) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  store.save(make_attempt("before"));
  store.limit_pages(16);
  const std::string message =
      message_of<IoError>([&] { store.save(make_attempt("too much", 500000)); });
  EXPECT_THAT(message, HasSubstr("disk is full; free some space"));
  store.limit_pages(100000);
  ASSERT_EQ(store.list().size(), 1U);
  store.save(make_attempt("after", 500000));
  EXPECT_EQ(store.list().size(), 2U);
}

TEST(AttemptStore, FileThatCannotGrowKeepsWhatWasThere) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  store.save(make_attempt("before"));
  {
    const FileSizeLimit limit(60000);
    const std::string message =
        message_of<IoError>([&] { store.save(make_attempt("too much", 500000)); });
    EXPECT_THAT(message, HasSubstr("free some space"));
  }
  EXPECT_EQ(AttemptStore(folder / "attempts.sqlite").list().size(), 1U);
  store.save(make_attempt("after", 500000));
  EXPECT_EQ(store.list().size(), 2U);
}

TEST(AttemptStore, KeepsWhetherTheCaseIsSimulated) {
  const TemporaryFolder folder;
  AttemptStore store(folder / "attempts.sqlite");
  for (const std::optional<bool> simulated : {std::optional(true), std::optional(false), {}}) {
    Attempt attempt = make_attempt("Ada");
    attempt.summary.case_simulated = simulated;
    const std::int64_t id = store.save(attempt);
    EXPECT_EQ(store.find(id)->summary.case_simulated, simulated);
    EXPECT_EQ(store.list().front().case_simulated, simulated);
  }
}

TEST(AttemptStore, TakesOverRecordsFromBeforeAnybodyNotedWhetherTheCaseIsSimulated) {
  const TemporaryFolder folder;
  {
    SQLite::Database database((folder / "attempts.sqlite").string(),
                              SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec(detail::kMigrations[0]);
    database.exec(
        "INSERT INTO attempt VALUES (7, 'Ada', 'demo wrist', '00ff00ff00ff00ff', 'p', 'mouse', "
        "'2026-01-31T12:00:00.000Z', '2026-01-31T12:05:00.250Z', 'unfinished', NULL, 5, "
        "'0123456789abcdef', '', '[]', '')");
    database.exec("PRAGMA application_id = " + std::to_string(detail::kApplicationId));
    database.exec("PRAGMA user_version = 1");
  }
  AttemptStore store(folder / "attempts.sqlite");
  ASSERT_EQ(store.list().size(), 1U);
  EXPECT_EQ(store.find(7)->summary.case_name, "demo wrist");
  EXPECT_EQ(store.find(7)->summary.case_simulated, std::nullopt);
  EXPECT_EQ(store.save(make_attempt("Grace")), 8);
  EXPECT_EQ(store.find(8)->summary.case_simulated, true);
}

TEST(AttemptStore, RefusesANewerSchema) {
  const TemporaryFolder folder;
  { AttemptStore store(folder / "attempts.sqlite"); }
  {
    SQLite::Database database((folder / "attempts.sqlite").string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA user_version = 99");
  }
  const std::string message =
      message_of<SchemaError>([&] { AttemptStore(folder / "attempts.sqlite"); });
  EXPECT_THAT(message, HasSubstr("99 is newer"));
  EXPECT_THAT(message, HasSubstr("update Carpus"));
}

TEST(AttemptStore, RefusesADatabaseOfAnotherProgram) {
  const TemporaryFolder folder;
  {
    SQLite::Database database((folder / "other.sqlite").string(),
                              SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("CREATE TABLE diary (day TEXT)");
  }
  EXPECT_THAT(message_of<IoError>([&] { AttemptStore(folder / "other.sqlite"); }),
              HasSubstr("another program"));
}

TEST(AttemptStore, RefusesAFileThatIsNoDatabase) {
  const TemporaryFolder folder;
  std::ofstream(folder / "notes.txt") << std::string(5000, 'x');
  EXPECT_THAT(message_of<IoError>([&] { AttemptStore(folder / "notes.txt"); }),
              HasSubstr("not a records file"));
}

TEST(AttemptStore, SaysThatAPlaceCannotBeWritten) {
  const TemporaryFolder folder;
  for (const auto& file : {folder / "missing/attempts.sqlite",
                           std::filesystem::path("/proc/attempts.sqlite"), folder.path()}) {
    EXPECT_THAT(message_of<IoError>([&] { AttemptStore store(file); }), HasSubstr("--records"))
        << file;
  }
}

}  // namespace
}  // namespace carpus::records
