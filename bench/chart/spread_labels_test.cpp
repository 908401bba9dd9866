// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/spread_labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace carpus::bench {
namespace {

TEST(SpreadLabels, LeavesThoseThatHaveRoom) {
  const std::vector<double> wanted{50, 10, 30};
  EXPECT_EQ(spread_labels(wanted, 14, 0, 100), wanted);
}

TEST(SpreadLabels, SharesTheShiftOfTwoThatCollide) {
  const std::vector<double> places = spread_labels({50, 52}, 14, 0, 100);
  EXPECT_DOUBLE_EQ(places[0], 44);
  EXPECT_DOUBLE_EQ(places[1], 58);
}

TEST(SpreadLabels, KeepsOrderSpacingAndFrame) {
  const std::vector<double> wanted{99, 98, 5, 97, 60, 96, 61};
  const std::vector<double> places = spread_labels(wanted, 10, 0, 100);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_GE(places[i], 0);
    EXPECT_LE(places[i], 100 + 1e-12);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (wanted[i] < wanted[k]) {
        EXPECT_GE(places[k] - places[i], 10 - 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace carpus::bench
