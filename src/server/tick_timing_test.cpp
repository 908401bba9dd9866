// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/tick_timing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace carpus::server {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Passes by hand alone, so that what is tested does not depend on how busy the machine is.
class TimeByHand final : public TickTime {
 public:
  std::int64_t now_ns() noexcept override { return now_; }
  void sleep_until(std::int64_t due_ns) noexcept override { now_ = std::max(now_, due_ns); }
  void pass(std::int64_t ns) { now_ += ns; }

 private:
  std::int64_t now_ = 77 * kMs;
};

struct TickClockTest : ::testing::Test {
  TimeByHand time;
  TickClock clock{time};
  std::int64_t began = 0;

  void SetUp() override {
    clock.start();
    began = time.now_ns();
  }
  void tick(std::int64_t work_ns) {
    clock.wait();
    time.pass(work_ns);
    clock.work_done(true);
  }
  [[nodiscard]] std::int64_t elapsed() { return time.now_ns() - began; }
};

TEST_F(TickClockTest, GivesAThousandTicksASecond) {
  for (int i = 0; i < 1000; ++i) tick(100'000);
  EXPECT_EQ(elapsed(), 1000 * kMs + 100'000);
  EXPECT_EQ(clock.timing().ticks, 1000U);
  EXPECT_EQ(clock.timing().late_ticks, 0U);
  EXPECT_NEAR(clock.timing().rate_hz, 1000.0, 0.2);
}

TEST_F(TickClockTest, MakesUpForAShortStop) {
  tick(0);
  time.pass(50 * kMs);
  for (int i = 1; i < 100; ++i) tick(10'000);
  EXPECT_LT(elapsed(), 101 * kMs);
  EXPECT_EQ(clock.timing().ticks, 100U);
  // The n-th after the stop begins 49 - 0.99 n ms late: more than a tick for n = 0 to 48.
  EXPECT_EQ(clock.timing().late_ticks, 49U);
}

TEST_F(TickClockTest, GivesUpALongStopAndCountsIt) {
  tick(0);
  time.pass(500 * kMs);
  for (int i = 1; i < 100; ++i) tick(10'000);
  EXPECT_EQ(clock.timing().ticks, 100U);
  EXPECT_EQ(elapsed(), 599 * kMs + 10'000) << "one tick at once, then at its pace";
  EXPECT_EQ(clock.timing().late_ticks, 499U);
}

TEST_F(TickClockTest, SlowWorkLowersTheRate) {
  for (int i = 0; i < 1000; ++i) tick(2 * kMs);
  EXPECT_NEAR(clock.timing().rate_hz, 500.0, 1.0);
}

TEST_F(TickClockTest, MeasuresWorkByItsQuantiles) {
  for (int i = 0; i < 1000; ++i) tick(i % 50 == 0 ? 400'000 : 80'000);
  tick(700'000);
  const TickTiming& timing = clock.timing();
  EXPECT_FLOAT_EQ(static_cast<float>(timing.p50_us), 80.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(timing.p99_us), 400.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(timing.worst_us), 700.0F);
  EXPECT_NEAR(timing.whole_p50_us, 80.0, 80.0 * 0.03);
  EXPECT_NEAR(timing.whole_p99_us, 400.0, 400.0 * 0.03);
}

TEST_F(TickClockTest, PausesAreNotMeasured) {
  for (int i = 0; i < 1000; ++i) tick(80'000);
  clock.wait();
  time.pass(90 * kMs);
  clock.work_done(false);
  EXPECT_EQ(clock.timing().ticks, 1000U);
  EXPECT_EQ(clock.timing().rate_hz, 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(clock.timing().worst_us), 80.0F);
}

}  // namespace
}  // namespace carpus::server
