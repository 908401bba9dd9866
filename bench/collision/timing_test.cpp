// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace carpus::bench {
namespace {

/// Readings of a clock that advances by 10.
std::vector<std::vector<double>> read_in_tens(const std::vector<double>& times, Rng& rng) {
  std::vector<std::vector<double>> passes(10, times);
  for (auto& pass : passes) {
    for (double& t : pass) {
      const double phase = rng.uniform(0, 10);
      t = 10 * std::floor((t + phase) / 10);
    }
  }
  return passes;
}

TEST(TimingOf, IsNotMisledByAClockThatAdvancesInSteps) {
  Rng rng(3);
  for (const double truth : {3.0, 17.0, 20.0, 36.8}) {
    const auto passes = read_in_tens(std::vector<double>(4000, truth), rng);
    EXPECT_NEAR(timing_of(passes, 10).mean, truth, 0.3);
    if (truth != 20) {
      EXPECT_LT(timing_of(passes).mean, truth - 2);  // the least of ten
    }
  }
}

TEST(TimingOf, LeavesOutWhatElseTheMachineDid) {
  Rng rng(4);
  auto passes = read_in_tens(std::vector<double>(1000, 25), rng);
  for (std::size_t p = 0; p < 5; ++p) {
    for (double& t : passes[p]) t += 500;
  }
  const Timing timing = timing_of(passes, 10);
  EXPECT_NEAR(timing.mean, 25, 0.5);
  EXPECT_LE(timing.worst, 30);
  EXPECT_GE(timing.p99_one_pass, 500);  // but for the first pass alone
}

TEST(TimingOf, SortsQueriesByTheirTimes) {
  std::vector<double> times;
  for (int i = 0; i < 1000; ++i) times.push_back(i);
  const Timing timing = timing_of({times, times});
  EXPECT_EQ(timing.queries, 1000U);
  EXPECT_EQ(timing.median, 500);
  EXPECT_EQ(timing.p99, 990);
  EXPECT_EQ(timing.worst, 999);
  EXPECT_DOUBLE_EQ(timing.mean, 499.5);
  EXPECT_EQ(timing_of({}).queries, 0U);
}

TEST(TimingOf, IsNeverBelowZero) {
  const Timing timing = timing_of({{-3, -2}, {-4, -1}}, 10);
  EXPECT_EQ(timing.mean, 0);
  EXPECT_EQ(timing.median, 0);
  EXPECT_EQ(timing.worst, 0);
}

}  // namespace
}  // namespace carpus::bench
