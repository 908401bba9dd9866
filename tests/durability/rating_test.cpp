// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An instructor amends a form while the disk refuses, is full, or loses its power: a form that was
// said to be saved is there, whole and the last; one that was refused can be saved once the disk is
// well.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <atomic>
#include <filesystem>
#include <new>
#include <random>
#include <string>

#include "child_process.hpp"
#include "core/error.hpp"
#include "disk_shim.hpp"
#include "records/attempt_keeper.hpp"
#include "records/attempt_store.hpp"
#include "records/records_test_support.hpp"

namespace carpus::durability {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using records::AssetForm;
using records::AssetSaving;

/// Forms that are saved one over the other while the disk is not well.
constexpr int kForms = 12;
/// Exit status of a station that did not start, which says so and has lost nothing.
constexpr int kDidNotStart = 8;
/// Exit status where all was done before the change that was to fail.
constexpr int kNothingFailed = 9;

/// Survives the process that rates.
struct Told {
  std::atomic<int> refused{0};          ///< forms that were said not to be stored
  std::atomic<std::int64_t> saved{0};   ///< revision that was said to be saved last
  std::atomic<std::int64_t> at_cut{0};  ///< the same when the power was cut
};

std::string comment_of(std::int64_t revision) {
  return std::to_string(revision) + std::string(3000, '.');
}

AssetForm form_of(std::int64_t revision) {
  AssetForm form;
  form.attempt = 1;
  form.rater = "Dr A";
  form.saved_at = "2026-01-31T12:00:00.000Z";
  form.answers_json = R"([{"domain":"safety","points":4}])";
  form.comment = comment_of(revision);
  return form;
}

class RatingDurability : public ::testing::Test {
 protected:
  RatingDurability()
      : told_(new(::mmap(nullptr,
                         sizeof(Told),
                         PROT_READ | PROT_WRITE,
                         MAP_SHARED | MAP_ANONYMOUS,
                         -1,
                         0)) Told) {}
  ~RatingDurability() override { ::munmap(told_, sizeof(Told)); }

  /// A folder with the records of one attempt, whose disk follows `plan` while a process rates.
  int rate(const std::string& name, DiskPlan plan) {
    told_->refused = 0;
    told_->saved = told_->at_cut = 0;
    plan.folder = folder_ / name;
    fs::create_directory(plan.folder);
    const fs::path file = plan.folder / "attempts.sqlite";
    (void)records::AttemptStore(file).save(records::testing::make_attempt("Ada"));
    return wait_for(start([&] {
      begin(plan);
      try {
        records::AttemptKeeper keeper(file, {}, {20ms, 10min});
        for (int i = 0; i < kForms; ++i) amend(keeper);
        if (plan.fail_at != 0 && changes() < plan.fail_at) return kNothingFailed;
        mend();
        const int refused = told_->refused;
        amend(keeper);
        return told_->refused == refused ? 0 : 1;
      } catch (const Error&) {
        return kDidNotStart;
      }
    }));
  }

  /// As the page: it begins from the last form that it can see.
  void amend(records::AttemptKeeper& keeper) const {
    try {
      const auto forms = keeper.asset_forms(1);
      const std::int64_t seen = forms.empty() ? 0 : forms.front().revision;
      if (keeper.save(form_of(seen + 1), seen) == AssetSaving::Saved) {
        told_->saved = seen + 1;
        return;
      }
    } catch (const IoError&) {
      // said below
    }
    ++told_->refused;
  }

  /// What a new station finds.
  static void expect_found(const fs::path& folder, std::int64_t saved, const std::string& when) {
    const records::AttemptStore store(folder / "attempts.sqlite");
    const auto attempt = store.find(1);
    ASSERT_TRUE(attempt) << when;
    EXPECT_FALSE(attempt->score_json.empty()) << when;
    const auto forms = store.asset_forms(1);
    ASSERT_EQ(forms.size(), saved == 0 && forms.empty() ? 0U : 1U) << when;
    if (forms.empty()) return;
    EXPECT_GE(forms.front().revision, saved) << when;
    EXPECT_EQ(forms.front().comment, comment_of(forms.front().revision)) << when;
  }

  const records::testing::TemporaryFolder folder_;
  Told* told_;
};

TEST_F(RatingDurability, DiskThatRefusesOneChangeOrAllUntilItIsFreed) {
  const std::uint64_t step = is_long() ? 1 : 3;
  int refused = 0;
  for (const bool for_good : {false, true}) {
    int status = 0;
    for (std::uint64_t at = 1; status != kNothingFailed && at < 1000; at += step) {
      const std::string name = (for_good ? "all " : "one ") + std::to_string(at);
      DiskPlan plan;
      plan.fail_at = at;
      plan.fails_for_good = for_good;
      status = rate(name, plan);
      EXPECT_THAT(status, ::testing::AnyOf(0, kDidNotStart, kNothingFailed)) << name;
      refused += told_->refused;
      expect_found(folder_ / name, told_->saved, name);
    }
    EXPECT_EQ(status, kNothingFailed) << "not every change was tried";
  }
  EXPECT_GT(refused, 0) << "nothing was refused: nothing was tried";
  std::printf("%d forms refused\n", refused);
}

TEST_F(RatingDurability, PowerCutAtAnyChangeOfTheDisk) {
  const std::uint64_t step = is_long() ? 1 : 5;
  std::mt19937_64 random(3);
  int cuts = 0;
  int status = kPowerCut;
  for (std::uint64_t at = 1; status == kPowerCut && at < 1000; at += step) {
    DiskPlan plan;
    plan.cut_at = at;
    plan.after = folder_ / ("after " + std::to_string(at));
    plan.unflushed = at % 2 == 0 ? Unflushed::Nothing : Unflushed::SomePages;
    plan.seed = random();
    plan.on_cut = [this] { told_->at_cut = told_->saved.load(); };
    fs::create_directory(plan.after);
    status = rate("cut " + std::to_string(at), plan);
    if (status != kPowerCut) continue;
    ++cuts;
    expect_found(plan.after, told_->at_cut, "power cut at " + std::to_string(at));
  }
  EXPECT_EQ(status, 0) << "not every change was tried";
  EXPECT_GT(cuts, 5);
  std::printf("%d power cuts\n", cuts);
}

}  // namespace
}  // namespace carpus::durability
