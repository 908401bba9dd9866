// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/double_double.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace carpus::convex {
namespace {

TEST(DoubleDouble, KeepsWhatADoubleLoses) {
  const DoubleDouble sum = DoubleDouble(1e16) + DoubleDouble(1) - DoubleDouble(1e16);
  EXPECT_EQ(sum.high, 1);
  const DoubleDouble product = DoubleDouble::product(1 + 0x1p-52, 1 - 0x1p-52);
  EXPECT_EQ(product.high, 1);
  EXPECT_EQ(product.low, -0x1p-104);
}

TEST(DoubleDouble, InvertsItsOperationsToTwiceTheDigits) {
  Rng rng(31);
  for (int i = 0; i < 20000; ++i) {
    const auto number = [&] {
      return DoubleDouble::sum(rng.uniform(-1, 1) * std::pow(10.0, rng.uniform(-9, 9)),
                               rng.uniform(-1, 1));
    };
    const DoubleDouble a = number();
    const DoubleDouble b = number();
    const DoubleDouble scale = std::abs(a.high) + std::abs(b.high);
    EXPECT_LE(std::abs((a + b - b - a).high), 0x1p-100 * scale.high);
    EXPECT_LE(std::abs((a / b * b - a).high), 0x1p-98 * std::abs(a.high));
    EXPECT_EQ(a < b, (a - b).high < 0);
    EXPECT_EQ(a > b, (b - a).high < 0);
  }
}

}  // namespace
}  // namespace carpus::convex
