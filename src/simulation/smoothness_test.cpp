// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/smoothness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace carpus::simulation::detail {
namespace {

using procedure::SmoothnessFacts;

/// Of the geometric mean.
double log_jerk(const SmoothnessFacts& facts) {
  return (std::log(facts.product) + facts.octaves * std::log(2.0)) / facts.stretches;
}

/// A tip that is led to and fro, reach after reach.
class Led {
 public:
  /// @param tremor_mm  amplitude of 9 Hz, in each direction
  explicit Led(double tremor_mm = 0) : tremor_mm_(tremor_mm) {}

  void reach(double mm, double s) {
    const int ticks = static_cast<int>(std::lround(s * 1000));
    for (int i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / ticks;
      const double cubed = share * share * share;
      tick(at_ + mm * cubed * (10 + share * (-15 + 6 * share)));
    }
    at_ += mm;
  }
  void rest(double s) {
    for (int i = 0; i < std::lround(s * 1000); ++i) tick(at_);
  }
  /// Reaches as long as a stretch, one after the other.
  void to_and_fro(double s, int times, double rest_s = 0) {
    for (int i = 0; i < times; ++i) {
      reach(i % 2 == 0 ? procedure::kStretchMm : -procedure::kStretchMm, s);
      rest(rest_s);
    }
  }
  void put(double at) { at_ = at; }
  void tick(double x) {
    const double shaken = tremor_mm_ * std::sin(2 * 3.14159265358979 * 9 * 0.001 * ++ticks_);
    add_tip(meter, Vec3{x, 0, 0} + Vec3{1, 1, 1} * shaken, facts);
  }

  MotionMeter meter;
  SmoothnessFacts facts;

 private:
  double tremor_mm_;
  double at_ = 0;
  int ticks_ = 0;
};

TEST(Smoothness, MinimumJerkReachesHaveTheirKnownValue) {
  Led led;
  led.to_and_fro(1.0, 40);
  EXPECT_GE(led.facts.stretches, 35U);
  EXPECT_NEAR(log_jerk(led.facts), std::log(204.8), 0.15);
}

TEST(Smoothness, SlowAndFastReachesOfTheSameFormAreEquallySmooth) {
  Led slow;
  Led fast;
  slow.to_and_fro(1.6, 40);
  fast.to_and_fro(0.8, 40);
  EXPECT_NEAR(log_jerk(slow.facts), log_jerk(fast.facts), 0.15);
}

TEST(Smoothness, TremorMakesItWorseAndMoreTremorMore) {
  double before = 0;
  for (const double tremor_mm : {0.0, 0.02, 0.05, 0.1}) {
    Led led(tremor_mm);
    led.to_and_fro(1.0, 40);
    EXPECT_GT(log_jerk(led.facts), before + 0.5) << tremor_mm;
    before = log_jerk(led.facts);
  }
}

TEST(Smoothness, HopsOfAMillimetreAreJerkyThoughEachIsSmooth) {
  Led hops;
  for (int i = 0; i < 100; ++i) hops.reach(i / 5 % 2 == 0 ? 1.0 : -1.0, 0.3);
  Led rests;  // long enough to be no hesitation
  for (int i = 0; i < 100; ++i) {
    rests.reach(i / 5 % 2 == 0 ? 1.0 : -1.0, 0.3);
    rests.rest(1.5);
  }
  Led reaches;
  reaches.to_and_fro(1.5, 20);
  EXPECT_GT(log_jerk(hops.facts), log_jerk(reaches.facts) + 4);
  EXPECT_GT(log_jerk(rests.facts), log_jerk(reaches.facts) + 3) << "rests hide no hops";
}

TEST(Smoothness, RestAndTremorInPlaceAreNoMovement) {
  Led led(0.05);
  led.rest(60);
  EXPECT_EQ(led.facts, SmoothnessFacts{});
  Led rested;
  rested.to_and_fro(1.0, 40, 3.0);
  Led ceaseless;
  ceaseless.to_and_fro(1.0, 40);
  EXPECT_NEAR(log_jerk(rested.facts), log_jerk(ceaseless.facts), 0.6);
}

TEST(Smoothness, OneSlowSweepIsNoBetterThanAReach) {
  Led creeping;  // under what counts as movement
  for (int i = 0; i < 60'000; ++i) creeping.tick(0.0008 * i);
  EXPECT_EQ(creeping.facts.stretches, 0U);
  Led gliding;
  for (int i = 0; i < 60'000; ++i) gliding.tick(0.004 * i);
  EXPECT_GT(gliding.facts.stretches, 40U);
  EXPECT_NEAR(log_jerk(gliding.facts), std::log(204.8), 1e-9);
}

TEST(Smoothness, ATipThatIsPutElsewhereBeginsAnew) {
  Led led;
  led.to_and_fro(1.0, 20);
  const double smooth = log_jerk(led.facts);
  for (int i = 0; i < 10; ++i) {
    led.rest(0.001 * (2 * i + 1));  // whatever of a mean was gathered by then
    led.put(i % 2 == 0 ? 60.0 : 0.0);
    led.to_and_fro(1.0, 4);
  }
  EXPECT_GE(led.facts.stretches, 45U);
  EXPECT_NEAR(log_jerk(led.facts), smooth, 0.3);
}

TEST(Smoothness, StatesThatNoTickLeavesAreRefused) {
  Led led(0.05);
  led.to_and_fro(1.0, 7);
  ASSERT_TRUE(is_possible(led.meter, led.facts));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double product : {0.5, 2.0, nan}) {
    SmoothnessFacts wrong = led.facts;
    wrong.product = product;
    EXPECT_FALSE(is_possible(led.meter, wrong)) << product;
  }
  MotionMeter wrong = led.meter;
  wrong.mean_count = kMeans + 1;
  EXPECT_FALSE(is_possible(wrong, led.facts));
  wrong = led.meter;
  wrong.ticks = kMeanTicks;
  EXPECT_FALSE(is_possible(wrong, led.facts));
  wrong = led.meter;
  wrong.squared_jerk = -1;
  EXPECT_FALSE(is_possible(wrong, led.facts));
}

}  // namespace
}  // namespace carpus::simulation::detail
