// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/new_case_maker.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "cli/watched_program.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

TEST(NewCaseMaker, IdsAreFreePlainAndCountOn) {
  const server::CaseShelf shelf{
      {{"demo", "", "", "", "", {}, nullptr}, {"demo-2", "", "", "", "", {}, nullptr}}, "demo"};
  const fs::path none = "/nonexistent";
  EXPECT_EQ(free_id("demo", shelf, none), "demo-3");
  EXPECT_EQ(free_id("demo-2", shelf, none), "demo-3");
  EXPECT_EQ(free_id("../../etc", shelf, none), "etc-2");
  EXPECT_EQ(free_id("--..", shelf, none), "scan-2");
  EXPECT_EQ(free_id("a b/c", shelf, none), "a-b-c-2");
}

TEST(WatchedProgram, FollowsProgressAndNothingElse) {
  std::string stage;
  double fraction = 0;
  const Progress progress = [&](std::string_view name, double part) {
    stage = name;
    fraction = part;
  };
  EXPECT_TRUE(follow_progress("[ 12 %] distance fields         ", progress));
  EXPECT_EQ(stage, "distance fields");
  EXPECT_DOUBLE_EQ(fraction, 0.12);
  for (const char* line : {"carpus: no bone", "[x %] y", "[12] y", "", "[ 5 %]"}) {
    EXPECT_FALSE(follow_progress(line, progress)) << line;
  }
}

TEST(WatchedProgram, TellsHowItEndedAndWhatItSaidLast) {
  const std::atomic<bool> stop{false};
  std::string stage;
  const Progress progress = [&](std::string_view name, double) { stage = name; };
  const auto run = [&](const std::string& script, std::chrono::seconds longest) {
    return run_watched("/bin/sh", {"-c", script}, progress, stop, longest);
  };
  EXPECT_TRUE(run("echo '[ 50 %] half' >&2", 10s).is_well);
  EXPECT_EQ(stage, "half");
  const ProgramEnd failed = run("echo 'carpus: no bone' >&2; exit 1", 10s);
  EXPECT_FALSE(failed.is_well);
  EXPECT_EQ(failed.complaint, "carpus: no bone");
  EXPECT_NE(run("kill -SEGV $$", 10s).complaint, "");
  const ProgramEnd late = run("sleep 30", 0s);
  EXPECT_TRUE(late.was_stopped);
  // It has none of our descriptors.
  EXPECT_TRUE(run("test $(ls /proc/self/fd | wc -l) -le 4", 10s).is_well);
}

TEST(WatchedProgram, EndsWhenAskedAlsoWhatDoesNotWantTo) {
  std::atomic<bool> stop{false};
  std::thread asks([&] {
    std::this_thread::sleep_for(150ms);
    stop = true;
  });
  const auto from = std::chrono::steady_clock::now();
  const ProgramEnd end = run_watched("/bin/sh", {"-c", "trap '' TERM; while :; do sleep 1; done"},
                                     no_progress, stop, 60s);
  asks.join();
  EXPECT_TRUE(end.was_stopped);
  EXPECT_LT(std::chrono::steady_clock::now() - from, 20s);
}

}  // namespace
}  // namespace carpus::cli
