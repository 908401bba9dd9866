// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// ASSET forms in the records: found as they were, amended only by who saw the last one, told with
// the attempt once they are finished, and kept by an update and a repair.
#include "records/asset_form.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "records/attempt_keeper.hpp"
#include "records/attempt_store.hpp"
#include "records/detail/schema.hpp"
#include "records/records_care.hpp"
#include "records/records_test_support.hpp"

namespace carpus::records {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

AssetForm make_form(const std::string& rater, std::optional<int> total = 30) {
  AssetForm form;
  form.attempt = 1;
  form.rater = rater;
  form.saved_at = "2026-01-31T12:00:00.000Z";
  form.answers_json = R"([{"domain":"safety","points":4}])";
  form.comment = "Look round\nbefore you probe. ☺";
  form.total = total;
  if (total) form.passes = *total >= 24;
  return form;
}

class AssetForms : public ::testing::Test {
 protected:
  AssetForms() {
    AttemptStore store(file_);
    (void)store.save(testing::make_attempt("Ada"));
    (void)store.save(testing::make_attempt("Bela"));
  }
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "attempts.sqlite";
};

TEST_F(AssetForms, AreFoundAsTheyWereTheOldestFirst) {
  {
    AttemptStore store(file_);
    EXPECT_EQ(store.save(make_form("Dr B"), 0), AssetSaving::Saved);
    EXPECT_EQ(store.save(make_form("Dr A", std::nullopt), 0), AssetSaving::Saved);
  }
  const AttemptStore store(file_);
  const auto forms = store.asset_forms(1);
  ASSERT_EQ(forms.size(), 2U);
  AssetForm first = make_form("Dr B");
  first.revision = 1;
  EXPECT_EQ(forms[0], first);
  EXPECT_EQ(forms[1].total, std::nullopt);
  EXPECT_EQ(forms[1].passes, std::nullopt);
  EXPECT_TRUE(store.asset_forms(2).empty());
  EXPECT_TRUE(store.asset_forms(99).empty());
}

TEST_F(AssetForms, AreAmendedByWhoSawTheLastOneAlone) {
  AttemptStore store(file_);
  EXPECT_EQ(store.save(make_form("Dr A"), 1), AssetSaving::Stale) << "there is none yet";
  EXPECT_EQ(store.save(make_form("Dr A"), 0), AssetSaving::Saved);
  EXPECT_EQ(store.save(make_form("Dr A", 10), 0), AssetSaving::Stale);
  EXPECT_EQ(store.asset_forms(1).front().total, 30);
  EXPECT_EQ(store.save(make_form("Dr A", 33), 1), AssetSaving::Saved);
  EXPECT_EQ(store.save(make_form("Dr A", 10), 1), AssetSaving::Stale);
  const auto forms = store.asset_forms(1);
  ASSERT_EQ(forms.size(), 1U);
  EXPECT_EQ(forms.front().total, 33);
  EXPECT_EQ(forms.front().revision, 2);
}

TEST_F(AssetForms, AreOfAnAttemptThatIsThereAndNotWithoutEnd) {
  AttemptStore store(file_);
  AssetForm nowhere = make_form("Dr A");
  nowhere.attempt = 3;
  EXPECT_EQ(store.save(nowhere, 0), AssetSaving::NoAttempt);
  for (std::size_t i = 0; i < kMostAssetForms; ++i) {
    EXPECT_EQ(store.save(make_form("Dr " + std::to_string(i)), 0), AssetSaving::Saved);
  }
  EXPECT_EQ(store.save(make_form("one more"), 0), AssetSaving::Full);
  EXPECT_EQ(store.save(make_form("Dr 3"), 1), AssetSaving::Saved) << "its own can be amended";
  EXPECT_EQ(store.asset_forms(1).size(), kMostAssetForms);
}

TEST_F(AssetForms, AreToldWithTheAttemptOnceTheyAreFinished) {
  AttemptStore store(file_);
  const auto before = store.find(1);
  EXPECT_EQ(before->summary.asset, std::nullopt);
  EXPECT_EQ(store.save(make_form("Dr A", std::nullopt), 0), AssetSaving::Saved);
  EXPECT_EQ(store.find(1)->summary.asset, std::nullopt);
  EXPECT_EQ(store.save(make_form("Dr B", 21), 0), AssetSaving::Saved);
  EXPECT_EQ(store.save(make_form("Dr C", 30), 0), AssetSaving::Saved);
  const AssetSummary told{2, 1, 25.5};
  EXPECT_EQ(store.find(1)->summary.asset, told);
  EXPECT_EQ(store.list().back().asset, told);
  EXPECT_EQ(store.page(0, 10).attempts.back().asset, told);
  EXPECT_EQ(store.page(0, 10).attempts.front().asset, std::nullopt) << "of another attempt";
  EXPECT_EQ(store.find(1)->summary.overall, before->summary.overall) << "the score is its own";
}

TEST_F(AssetForms, GoIntoRecordsFromBeforeThereWereAny) {
  const std::filesystem::path old = folder_ / "old.sqlite";
  {
    SQLite::Database database(old.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    for (std::size_t version = 0; version < 5; ++version) {
      database.exec(detail::kMigrations[version]);
    }
    database.exec(
        "INSERT INTO attempt (id, trainee, case_name, case_fingerprint, procedure, input_device, "
        "started_at, ended_at, outcome, duration_ticks, final_hash, score, events, recording) "
        "VALUES (1, 'Ada', 'demo wrist', '00ff00ff00ff00ff', 'p', 'mouse', "
        "'2026-01-31T12:00:00.000Z', '2026-01-31T12:05:00.250Z', 'unfinished', 5, "
        "'0123456789abcdef', '', '[]', '')");
    database.exec("PRAGMA application_id = " + std::to_string(detail::kApplicationId));
    database.exec("PRAGMA user_version = 5");
  }
  AttemptStore store(old);
  EXPECT_EQ(store.find(1)->summary.trainee, "Ada");
  EXPECT_TRUE(store.asset_forms(1).empty());
  EXPECT_EQ(store.save(make_form("Dr A"), 0), AssetSaving::Saved);
}

TEST_F(AssetForms, ARepairKeepsThem) {
  {
    AttemptStore store(file_);
    EXPECT_EQ(store.save(make_form("Dr A"), 0), AssetSaving::Saved);
    EXPECT_EQ(store.save(make_form("Dr A", 35), 1), AssetSaving::Saved);
  }
  EXPECT_EQ(repair_records(file_).saved, 2);
  const auto forms = AttemptStore(file_).asset_forms(1);
  ASSERT_EQ(forms.size(), 1U);
  EXPECT_EQ(forms.front().total, 35);
  EXPECT_EQ(forms.front().revision, 2);
}

TEST_F(AssetForms, WhatTheRecordsRefuseIsSaidAndDoesNotWait) {
  using namespace std::chrono_literals;
  AttemptKeeper keeper(file_, {}, {20ms, 10min});
  {
    SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE);
    other.exec("BEGIN IMMEDIATE");
    EXPECT_THAT([&] { (void)keeper.save(make_form("Dr A"), 0); },
                ::testing::ThrowsMessage<IoError>(HasSubstr("the form was not stored")));
    EXPECT_EQ(keeper.waiting(), 0U);
    other.exec("ROLLBACK");
  }
  EXPECT_EQ(keeper.save(make_form("Dr A"), 0), AssetSaving::Saved);
  EXPECT_EQ(keeper.asset_forms(1).size(), 1U);
}

}  // namespace
}  // namespace carpus::records
