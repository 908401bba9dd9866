// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::bench {
namespace {

HullRow row_of(const char* set, const char* engine, std::size_t n, double seconds) {
  return {.set = set,
          .engine = engine,
          .n = n,
          .h = 100,
          .ran = true,
          .agrees = true,
          .seconds = seconds};
}

TEST(Growth, APowerIsFoundAgain) {
  std::vector<GrowthSample> samples;
  for (const double n : {1e4, 3e4, 1e5, 1e6}) samples.push_back({n, 1e-9 * std::pow(n, 1.25)});
  EXPECT_NEAR(exponent_of(samples), 1.25, 1e-9);
}

TEST(Growth, NLogNHasAnExponentAboveOneOfItsOwn) {
  const std::vector<GrowthSample> samples{{1e4, 1}, {3e4, 1}, {1e5, 1}, {3e5, 1}, {1e6, 1}};
  EXPECT_NEAR(n_log_n_exponent(samples), 1.088, 5e-4);
}

TEST(Growth, AJumpShowsInItsStepAlone) {
  const std::vector<HullRow> rows{
      row_of("ball", "fast", 100'000, 3.0), row_of("ball", "fast", 1'000, 0.01),
      row_of("ball", "fast", 10'000, 0.1), row_of("ball", "chan", 1'000, 0.1)};
  const std::vector<Growth> growth = growth_with_points(rows);
  ASSERT_EQ(growth.size(), 1U);  // chan ran on one size only
  const std::vector<double> steps = growth[0].steps();
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(steps[0], 1, 1e-9);
  EXPECT_NEAR(steps[1], std::log10(30), 1e-9);
}

TEST(Growth, CornersAreThoseOfTheExactHull) {
  std::vector<HullRow> rows{row_of("sphere", "bullet", 1'000, 1),
                            row_of("sphere", "fast", 1'000, 1), row_of("ball", "bullet", 1'000, 1)};
  rows[0].agrees = rows[2].agrees = false;
  rows[0].h = 900;
  rows[1].h = 1'000;
  const ExactCorners corners(rows);
  EXPECT_EQ(corners.of(rows[0]), 1'000U);
  EXPECT_EQ(corners.of(rows[2]), 0U);
}

}  // namespace
}  // namespace carpus::bench
