// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whatever ends a station, no finished attempt is lost, at most the last second of a running one,
// and nothing is half written. CARPUS_LONG=1 takes more moments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "child_process.hpp"
#include "core/error.hpp"
#include "disk_shim.hpp"
#include "scenario.hpp"

namespace carpus::durability {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class Durability : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { prepare(); }

  Durability() {
    std::string name = (fs::temp_directory_path() / "carpus-durability-XXXXXX").string();
    root_ = ::mkdtemp(name.data());
  }
  ~Durability() override { fs::remove_all(root_); }

  fs::path fresh(const std::string& name) {
    fs::remove_all(root_ / name);
    fs::create_directory(root_ / name);
    return root_ / name;
  }

  void judge(const Found& found, const std::string& when) {
    EXPECT_EQ(found.fault, "") << when;
    most_lost_ = std::max(most_lost_, found.lost_ticks);
    went_on_ += found.went_on ? 1 : 0;
  }
  void report(const char* what, int moments) const {
    std::printf("%d %s: at most %llu ticks of the running exercise lost, %d went on\n", moments,
                what, static_cast<unsigned long long>(most_lost_), went_on_);
  }

  fs::path root_;
  std::uint64_t most_lost_ = 0;
  int went_on_ = 0;
};

TEST_F(Durability, KilledAtAnyMoment) {
  const int moments = is_long() ? 1000 : 20;
  std::mt19937_64 random(1);
  for (int i = 0; i < moments; ++i) {
    const fs::path folder = fresh("station");
    const SharedProgress progress;
    const pid_t child = start([&] { return static_cast<int>(operate(folder, *progress, 60'000)); });
    while (progress->begun == 0) std::this_thread::sleep_for(100us);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 300'000));
    ::kill(child, SIGKILL);
    (void)wait_for(child);
    judge(start_anew(folder, *progress), "killed at moment " + std::to_string(i));
  }
  report("kills", moments);
  EXPECT_GT(went_on_, moments / 3);
}

TEST_F(Durability, PowerCutAtAnyChangeOfTheDisk) {
  // How many there are.
  std::uint64_t changes_in_all = 0;
  {
    const fs::path folder = fresh("station");
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const SharedProgress progress;
    const pid_t child = start([&] {
      begin({folder, 0, false, 0, {}, {}, 1, {}});
      (void)operate(folder, *progress, 12'000);
      const std::uint64_t count = changes();
      return ::write(pipe[1], &count, sizeof count) == sizeof count ? 0 : 1;
    });
    EXPECT_EQ(wait_for(child), 0);
    ASSERT_EQ(::read(pipe[0], &changes_in_all, sizeof changes_in_all),
              static_cast<ssize_t>(sizeof changes_in_all));
    for (const int end : pipe) ::close(end);
  }
  const int moments = is_long() ? 200 : 20;
  std::mt19937_64 random(2);
  int cuts = 0;
  // Where the threads take fewer steps than they did, a run ends before its cut.
  for (int i = 0; cuts < moments && i < 2 * moments; ++i) {
    const fs::path folder = fresh("station");
    const fs::path after = fresh("after");
    const SharedProgress progress;
    const SharedProgress at_cut;
    DiskPlan plan;
    plan.folder = folder;
    plan.cut_at = 1 + random() % changes_in_all;
    plan.after = after;
    plan.unflushed = i % 2 == 0 ? Unflushed::Nothing : Unflushed::SomePages;
    plan.seed = random();
    plan.on_cut = [&] { at_cut.copy_from(progress); };
    const pid_t child = start([&] {
      begin(plan);
      return static_cast<int>(operate(folder, *progress, 12'000));
    });
    const int status = wait_for(child);
    if (status != kPowerCut) continue;
    ++cuts;
    judge(start_anew(after, *at_cut), "power cut at change " + std::to_string(plan.cut_at) +
                                          (i % 2 == 0 ? "" : ", some pages left"));
  }
  EXPECT_EQ(cuts, moments);
  report("power cuts", cuts);
}

/// An attempt that is over when the disk is well again is in the records, once.
void expect_all_stored(const fs::path& folder, const Progress& progress, std::uint64_t failing) {
  const Found found = start_anew(folder, progress);
  EXPECT_EQ(found.fault, "") << "change " << failing << " failed";
}

TEST_F(Durability, DiskThatRefusesAnyOneChange) {
  std::uint64_t failing = 1;
  int refused_at_the_start = 0;
  const std::uint64_t step = is_long() ? 1 : 7;
  for (bool is_beyond = false; !is_beyond && failing < 2000; failing += step) {
    const fs::path folder = fresh("station");
    const SharedProgress progress;
    const pid_t child = start([&] {
      begin({folder, failing, false, 0, {}, {}, 1, {}});
      try {
        const std::size_t waiting = operate(folder, *progress, 2000);
        if (changes() < failing) return 9;
        return waiting == 0 ? 0 : 1;
      } catch (const Error&) {
        return 8;  // a station that does not start says so and has lost nothing
      }
    });
    const int status = wait_for(child);
    is_beyond = status == 9;
    refused_at_the_start += status == 8 ? 1 : 0;
    EXPECT_TRUE(status == 0 || status == 8 || status == 9) << status << " at " << failing;
    expect_all_stored(folder, *progress, failing);
  }
  EXPECT_LT(refused_at_the_start, 40);
  std::printf("each of %llu changes refused once, %d of them at the start\n",
              static_cast<unsigned long long>(failing), refused_at_the_start);
}

TEST_F(Durability, DiskThatIsFullFromAnyChangeOnUntilItIsFreed) {
  const std::uint64_t step = is_long() ? 1 : 17;
  int tried = 0;
  for (std::uint64_t failing = 30; failing < 150; failing += step, ++tried) {
    const fs::path folder = fresh("station");
    const SharedProgress progress;
    const pid_t child = start([&] {
      begin({folder, failing, true, 0, {}, {}, 1, {}});
      std::thread frees([&] {
        std::this_thread::sleep_for(100ms);
        mend();
      });
      frees.detach();
      try {
        const std::size_t waiting = operate(folder, *progress, 40'000);
        return waiting == 0 ? 0 : 1;
      } catch (const Error&) {
        return 8;
      }
    });
    const int status = wait_for(child);
    EXPECT_TRUE(status == 0 || status == 8) << status << " at " << failing;
    if (status == 0) expect_all_stored(folder, *progress, failing);
  }
  std::printf("full at %d changes, freed later\n", tried);
}

}  // namespace
}  // namespace carpus::durability
