// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/log_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::bench {
namespace {

TEST(LogScale, PutsTheGeometricMiddleInTheMiddle) {
  const LogScale scale({1e-8, 1e-4}, 100, 500);
  EXPECT_DOUBLE_EQ(scale.at(1e-8), 100);
  EXPECT_NEAR(scale.at(1e-6), 300, 1e-9);
  EXPECT_NEAR(scale.at(1e-4), 500, 1e-9);
}

TEST(LogScale, RunsUpward) {
  const LogScale scale({1, 100}, 500, 100);
  EXPECT_NEAR(scale.at(10), 300, 1e-9);
}

TEST(LogScale, LabelsAsManyAsThereIsRoomFor) {
  const ValueRange range{0.9, 1100};
  EXPECT_EQ(LogScale(range, 0, 900).ticks(40).size(), 10U);  // 1, 2, 5, ... 1000
  EXPECT_EQ(LogScale(range, 0, 300).ticks(40).size(), 4U);   // powers of ten
  EXPECT_EQ(LogScale(range, 0, 60).ticks(30).size(), 2U);    // every second
}

TEST(LogScale, RangeIgnoresWhatHasNoLogarithm) {
  ValueRange range;
  range.include(0);
  range.include(std::nan(""));
  EXPECT_TRUE(range.is_empty());
  range.include(2);
  EXPECT_FALSE(range.is_empty());
}

TEST(Labels, AreShort) {
  EXPECT_EQ(time_label(1e-7), "100 ns");
  EXPECT_EQ(time_label(std::pow(10.0, -6)), "1 µs");
  EXPECT_EQ(time_label(0.05), "50 ms");
  EXPECT_EQ(time_label(20), "20 s");
  EXPECT_EQ(count_label(2000), "2000");
  EXPECT_EQ(count_label(1e6), "1 000 000");
}

}  // namespace
}  // namespace carpus::bench
