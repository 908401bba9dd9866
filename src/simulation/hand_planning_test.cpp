// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/hand_planning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carpus::simulation {
namespace {

constexpr Vec3 kUp{0, 0, 1};

HandInput planned(const Vec3& tip, const Vec3& shaft = kUp) {
  HandInput wish;
  wish.tip_in_patient = tip;
  wish.shaft_in_patient = shaft;
  wish.guidance = Guidance::Planned;
  return wish;
}

/// The plan after each tick, until it rests or `most` ticks have passed.
std::vector<HandPlan> way_to(HandPlan plan, const HandInput& wish, int most, bool is_free = true) {
  std::vector<HandPlan> way{plan};
  for (int i = 0; i < most; ++i) {
    advance(plan, wish, is_free);
    way.push_back(plan);
  }
  return way;
}

double greatest_height(const std::vector<HandPlan>& way) {
  double height = -1e9;
  for (const HandPlan& plan : way) height = std::max(height, plan.tip.z);
  return height;
}

TEST(HandPlanning, ArrivesExactlyWhereItIsWantedAndStays) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({40, 3, -2}, {1, 0, 1}), 1500);
  EXPECT_EQ(way.back().tip, (Vec3{40, 3, -2}));
  EXPECT_LT(distance(way.back().shaft, Vec3{1, 0, 1} / std::sqrt(2.0)), 1e-12);
  EXPECT_EQ(way.back().tip_velocity, Vec3{});
  EXPECT_EQ(way.back(), way[way.size() - 100]);
  EXPECT_EQ(way.back().phase, HandPhase::Following);
}

TEST(HandPlanning, NeverMovesTurnsOrSpeedsUpFasterThanAHand) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({80, -30, 5}, {0, 1, -0.5}), 1500);
  Vec3 before;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 moved = way[i].tip - way[i - 1].tip;
    EXPECT_LE(length(moved), kHandMmPerS * 0.001 * (1 + 1e-9));
    EXPECT_LE(length(moved - before), kHandMmPerS2 * 1e-6 * (1 + 1e-6)) << "tick " << i;
    EXPECT_LE(distance(way[i].shaft, way[i - 1].shaft), kHandRadPerS * 0.001 * (1 + 1e-9));
    EXPECT_NEAR(length(way[i].shaft), 1.0, 1e-12);
    before = moved;
  }
}

TEST(HandPlanning, LiftsFarWaysOverWhatIsBetween) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({40, 0, 0}), 1500);
  EXPECT_GT(greatest_height(way), 14.0);
  for (const HandPlan& plan : way) {
    if (plan.tip.x > 5 && plan.tip.x < 35) {
      EXPECT_GT(plan.tip.z, 9.0) << "at " << plan.tip.x;
    }
    EXPECT_GT(plan.tip.z, -1e-9);
    EXPECT_LT(plan.tip.x, 43.0);
  }
  // It comes down beside its goal by no more than what a tip slides.
  const auto low = std::find_if(way.begin(), way.end(), [](const HandPlan& plan) {
    return plan.phase == HandPhase::Lowering && plan.tip.z < 4.0;
  });
  ASSERT_NE(low, way.end());
  EXPECT_NEAR(low->tip.x, 40.0, 1.0);
}

TEST(HandPlanning, FollowsShortWaysStraight) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({3.9, 0, 0}), 300);
  EXPECT_EQ(greatest_height(way), 0.0);
  EXPECT_EQ(way.back().tip, (Vec3{3.9, 0, 0}));
}

TEST(HandPlanning, FollowsADragWithoutLiftingAndCloseBehind) {
  HandPlan plan = resting_at({0, 0, 0}, kUp);
  double x = 0;
  for (int tick = 0; tick < 400; ++tick) {
    if (tick % 16 == 0) x += 2.0;  // 125 mm/s, as a page tells it
    advance(plan, planned({x, 0, 0}), true);
    EXPECT_EQ(plan.tip.z, 0.0);
    EXPECT_LE(x - plan.tip.x, 6.0);
    EXPECT_LE(plan.tip.x, x);
  }
}

TEST(HandPlanning, PressesOnIntoWhatItTouches) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({0, 0, -3}), 300);
  EXPECT_EQ(way.back().tip, (Vec3{0, 0, -3}));
}

TEST(HandPlanning, LiftsNothingThatIsFixedInBone) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({40, 0, 0}), 600, false);
  EXPECT_EQ(greatest_height(way), 0.0);
  EXPECT_EQ(way.back().tip, (Vec3{40, 0, 0}));
}

TEST(HandPlanning, TakesTheNewestGoalInMidFlight) {
  HandPlan plan = resting_at({0, 0, 0}, kUp);
  for (int i = 0; i < 150; ++i) advance(plan, planned({40, 0, 0}), true);
  ASSERT_NE(plan.phase, HandPhase::Following);
  const auto way = way_to(plan, planned({0, 40, 0}), 1500);
  EXPECT_EQ(way.back().tip, (Vec3{0, 40, 0}));
  EXPECT_LT(greatest_height(way), kLiftMm + 4.0);
}

TEST(HandPlanning, FollowsADeviceAsItIs) {
  HandPlan plan = resting_at({0, 0, 0}, kUp);
  HandInput wish = planned({100, 0, 0}, {0, 2, 0});
  wish.guidance = Guidance::Direct;
  advance(plan, wish, true);
  EXPECT_EQ(plan.tip, (Vec3{100, 0, 0}));
  EXPECT_EQ(plan.shaft, (Vec3{0, 1, 0}));
}

TEST(HandPlanning, TurnsRoundByAnyWayToTheOppositeDirection) {
  const auto way = way_to(resting_at({0, 0, 0}, kUp), planned({0, 0, 0}, {0, 0, -1}), 2000);
  EXPECT_LT(distance(way.back().shaft, {0, 0, -1}), 1e-9);
}

}  // namespace
}  // namespace carpus::simulation
