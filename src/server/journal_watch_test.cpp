// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/journal_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carpus::server {
namespace {

using namespace std::chrono_literals;
using records::JournalProgress;
using ::testing::HasSubstr;

const JournalWatch::Clock::time_point kStart{};

JournalProgress safe_until(Tick tick, const std::string& problem = {}) {
  JournalProgress progress;
  progress.safe = tick;
  progress.problem = problem;
  return progress;
}

TEST(JournalWatch, LetsTimePassWhileTheDiskKeepsUp) {
  JournalWatch watch;
  for (Tick tick = 0; tick < 5000; tick += 16) {
    const auto verdict = watch.look(safe_until(tick > 600 ? tick - 600 : 0), tick, kStart);
    EXPECT_FALSE(verdict.holds_time);
    EXPECT_TRUE(verdict.word.empty());
  }
  EXPECT_FALSE(watch.look(std::nullopt, 1'000'000, kStart).holds_time) << "there is no journal";
}

TEST(JournalWatch, HoldsTimeForASlowDiskButNotForEver) {
  JournalWatch watch;
  EXPECT_TRUE(watch.look(safe_until(0), 900, kStart).holds_time);
  const auto waits = watch.look(safe_until(0), 900, kStart + 4s);
  EXPECT_TRUE(waits.holds_time);
  EXPECT_TRUE(waits.word.empty());
  const auto gives_up = watch.look(safe_until(0), 900, kStart + 6s);
  EXPECT_FALSE(gives_up.holds_time);
  EXPECT_THAT(gives_up.word, HasSubstr("taken nothing"));
  EXPECT_TRUE(watch.look(safe_until(0), 1200, kStart + 7s).word.empty()) << "said once";
  EXPECT_THAT(watch.look(safe_until(1200), 1300, kStart + 8s).word, HasSubstr("again"));
}

TEST(JournalWatch, GoesOnWithoutADiskThatRefusesAndSaysSo) {
  JournalWatch watch;
  const auto verdict = watch.look(safe_until(0, "disk full; free some space"), 2000, kStart);
  EXPECT_FALSE(verdict.holds_time);
  EXPECT_THAT(verdict.word, HasSubstr("free some space"));
  EXPECT_TRUE(
      watch.look(safe_until(0, "disk full; free some space"), 3000, kStart + 1s).word.empty());
}

}  // namespace
}  // namespace carpus::server
