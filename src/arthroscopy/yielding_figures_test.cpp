// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/yielding_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
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

/// Geissler [K, B9]: I level, II narrower than a probe, III a probe passes, IV the scope.
TEST(YieldingFigures, AnIntervalTakesInWhatGeisslersGradesSay) {
  const auto& wrist = test::generic_wrist();
  const std::vector<IntervalFigures> all = interval_figures(wrist.data, wrist.map);
  ASSERT_EQ(all.size(), 10U) << "five grades of two ligaments";
  for (const IntervalFigures& f : all) {
    const std::string what = f.band + " " + f.grade;
    EXPECT_GT(f.deep_mm, 5) << what;
    const bool lets_probe = f.grade == "III" || f.grade == "IV";
    const bool lets_scope = f.grade == "IV";
    const bool is_level = f.grade == "0" || f.grade == "I";
    EXPECT_EQ(f.gap_mm == 0, is_level) << what;
    if (lets_probe) {
      EXPECT_GT(f.probe_mm, 0.9 * f.deep_mm) << what;
    } else {
      EXPECT_LT(f.gap_mm, 1) << what;
      EXPECT_LT(f.probe_mm, 1) << what;
    }
    if (lets_scope) {
      EXPECT_GT(f.scope_mm, 0.9 * f.deep_mm) << what;
    } else {
      EXPECT_LT(f.scope_mm, 1) << what;
    }
  }
}

TEST(YieldingFigures, ACaseWithoutAMidcarpalJointHasNoIntervals) {
  cases::ArthroscopicMap map = test::generic_wrist().map;
  map.joints.resize(1);
  std::erase_if(map.points, [](const cases::TourPoint& point) { return point.joint > 0; });
  EXPECT_TRUE(interval_figures(test::generic_wrist().data, map).empty());
}

TEST(YieldingFigures, ACaseWithoutADiscHasNone) {
  cases::ArthroscopicMap map = test::generic_wrist().map;
  map.disc_sheet = {};
  EXPECT_TRUE(disc_figures(test::generic_wrist().data, map).empty());
}

}  // namespace
}  // namespace carpus::arthroscopy
