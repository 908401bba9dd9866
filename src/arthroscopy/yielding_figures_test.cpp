// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/yielding_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "arthroscopy/disc_table.hpp"
#include "arthroscopy/generic_wrist_test_support.hpp"

namespace carpus::arthroscopy {
namespace {

TEST(YieldingFigures, ATornFoveaIsToldByTheHookAndNotByTheTrampoline) {
  const auto& wrist = test::generic_wrist();
  const std::vector<DiscFigures> discs = disc_figures(wrist.data, wrist.map);
  ASSERT_EQ(discs.size(), 2U);
  const DiscFigures& whole = discs[0];
  const DiscFigures& off = discs[1];
  EXPECT_FALSE(whole.has_come_off);
  EXPECT_TRUE(off.has_come_off);
  const DiscTable::Published& published = DiscTable::generic().published;
  EXPECT_NEAR(whole.press_mm, published.pressed_whole_mm, 0.15) << "rebound of a whole disc";
  EXPECT_LT(std::abs(off.press_mm - whole.press_mm), 0.15) << "no difference [S78]";
  EXPECT_EQ(whole.rests_off_mm, 0);
  EXPECT_NEAR(off.rests_off_mm, published.rests_off_mm, 0.2) << "resting offset";
  EXPECT_GT(whole.lifted_mm, 0.1);
  EXPECT_GT(off.lifted_mm, 2 * whole.lifted_mm) << "slack [S77]";
}

TEST(YieldingFigures, ACaseWithoutADiscHasNone) {
  cases::ArthroscopicMap map = test::generic_wrist().map;
  map.disc_sheet = {};
  EXPECT_TRUE(disc_figures(test::generic_wrist().data, map).empty());
}

}  // namespace
}  // namespace carpus::arthroscopy
