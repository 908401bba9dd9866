// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/host_loop.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "core/allocation_test_support.hpp"
#include "core/error.hpp"

namespace carpus::devices {
namespace {

/// What a device was told, and what it says next.
struct Script {
  DeviceState says;
  DeviceCommand told;
  std::atomic<int> commands{0};
  std::atomic<int> opened{0};
  std::atomic<bool> is_plugged{true};
  /// It says who it is, and with it that it is one of stops.
  std::atomic<bool> says_unit{false};
};

class ScriptedDevice final : public Device {
 public:
  explicit ScriptedDevice(Script& script) : script_(script) {}
  [[nodiscard]] Capabilities capabilities() const override {
    Capabilities able;
    able.position = able.force = able.local_plane = true;
    able.stop = script_.says_unit;
    able.peak_force_n = 3;
    able.most_stiffness_n_per_mm = 2;
    return able;
  }
  void open() override {
    if (!script_.is_plugged) throw IoError("scripted: not there; plug it in");
    ++script_.opened;
  }
  void close() noexcept override {}
  void poll(Nanoseconds now, DeviceState& state) noexcept override {
    state = script_.says;
    state.has_unit = script_.says_unit;
    state.heard_ns = now;
    if (!script_.is_plugged) state.health = Health::Gone;
  }
  void command(Nanoseconds, const DeviceCommand& command) noexcept override {
    script_.told = command;
    ++script_.commands;
  }

 private:
  Script& script_;
};

TimedCommand push(double newtons, Nanoseconds at) {
  TimedCommand wish;
  wish.command.force_n = {0, 0, newtons};
  wish.command.limit_n = 100;
  wish.at_ns = at;
  return wish;
}

TEST(HostLoop, AWishThatIsOldIsNone) {
  Script script;
  script.says.health = Health::Good;
  ScriptedDevice device(script);
  LoopState state;
  state.able = device.capabilities();
  const Nanoseconds now = 1'000'000'000;
  EXPECT_TRUE(HostLoop::turn(device, now, push(2, now), state));
  EXPECT_EQ(script.told.force_n.z, 2);
  EXPECT_TRUE(HostLoop::turn(device, now + 6 * kNsPerMs, push(2, now), state));
  EXPECT_EQ(script.told.force_n.z, 0);
  EXPECT_EQ(script.told.limit_n, 0);
  EXPECT_EQ(state.stale, 1U);
  // Nor one of tomorrow.
  EXPECT_TRUE(HostLoop::turn(device, now, push(2, now + 10 * kNsPerMs), state));
  EXPECT_EQ(script.told.limit_n, 0);
}

TEST(HostLoop, NothingIsAskedOfADeviceThatIsNotWell) {
  Script script;
  ScriptedDevice device(script);
  LoopState state;
  state.able = device.capabilities();
  for (const Health health :
       {Health::Starting, Health::Uncalibrated, Health::Silent, Health::Faulty}) {
    script.says.health = health;
    EXPECT_TRUE(HostLoop::turn(device, 1000, push(2, 1000), state));
    EXPECT_EQ(script.told.limit_n, 0) << in_words(health);
  }
  script.says.health = Health::Gone;
  EXPECT_FALSE(HostLoop::turn(device, 1000, push(2, 1000), state));
}

TEST(HostLoop, WishesThatAreNoNumbersAreNoForce) {
  Script script;
  script.says.health = Health::Good;
  ScriptedDevice device(script);
  LoopState state;
  state.able = device.capabilities();
  const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity()};
  std::uint64_t faults = 0;
  for (const double number : bad) {
    for (int place = 0; place < 6; ++place) {
      TimedCommand wish = push(1, 1000);
      wish.command.plane_count = 1;
      wish.command.planes[0].stiffness_n_per_mm = 1;
      double* places[] = {&wish.command.force_n.x,          &wish.command.limit_n,
                          &wish.command.planes[0].normal.y, &wish.command.planes[0].offset_mm,
                          &wish.command.planes[0].friction, &wish.command.vibration_hz};
      *places[place] = number;
      (void)HostLoop::turn(device, 1000, wish, state);
      EXPECT_EQ(script.told.limit_n, 0) << place;
      EXPECT_EQ(script.told.plane_count, 0);
      EXPECT_EQ(state.faults, ++faults);
      EXPECT_TRUE(is_finite(state.asked_force_n));
    }
  }
}

TEST(HostLoop, TheLimiterIsTheDevicesAndOurs) {
  Script script;
  script.says.health = Health::Good;
  ScriptedDevice device(script);
  LoopState state;
  state.able = device.capabilities();
  TimedCommand wish = push(50, 1000);
  wish.command.plane_count = 200;
  wish.command.planes[0].stiffness_n_per_mm = 1000;
  wish.command.planes[1].stiffness_n_per_mm = -5;
  (void)HostLoop::turn(device, 1000, wish, state);
  EXPECT_DOUBLE_EQ(script.told.force_n.z, 3);
  EXPECT_DOUBLE_EQ(script.told.limit_n, 3);
  EXPECT_EQ(script.told.plane_count, kMostPlanes);
  EXPECT_EQ(script.told.planes[0].stiffness_n_per_mm, 2);
  EXPECT_EQ(script.told.planes[1].stiffness_n_per_mm, 0);
  EXPECT_LE(length(state.asked_force_n), 3.0001);
}

TEST(HostLoop, APlaceThatCannotBeIsAFaultAndTheLastOneStays) {
  Script script;
  script.says.health = Health::Good;
  script.says.position_mm = {1, 2, 3};
  ScriptedDevice device(script);
  LoopState state;
  (void)HostLoop::turn(device, 1000, {}, state);
  for (const Vec3& place : {Vec3{std::nan(""), 0, 0}, Vec3{1e9, 0, 0}}) {
    script.says.position_mm = place;
    (void)HostLoop::turn(device, 1000, {}, state);
    EXPECT_EQ(state.device.health, Health::Faulty);
    EXPECT_EQ(state.device.position_mm, (Vec3{1, 2, 3}));
  }
  script.says.position_mm = {};
  script.says.rotation.rows[1] = {0, 0, 0};
  (void)HostLoop::turn(device, 1000, {}, state);
  EXPECT_EQ(state.device.health, Health::Faulty);
}

TEST(HostLoop, ATurnAllocatesNothing) {
  Script script;
  script.says.health = Health::Good;
  ScriptedDevice device(script);
  LoopState state;
  TimeHistogram histogram;
  test::start_counting_allocations();
  for (int i = 0; i < 1000; ++i) {
    (void)HostLoop::turn(device, i, push(1, i), state);
    histogram.add(i);
    (void)histogram.quantile(0.99);
  }
  EXPECT_EQ(test::stop_counting_allocations(), 0);
}

/// Until something is so, at most two seconds.
template <typename Is>
bool soon(Is is) {
  for (int i = 0; i < 400; ++i) {
    if (is()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST(HostLoop, GoesOnAloneAndOpensAgainWhatWasUnplugged) {
  Script script;
  script.says.health = Health::Good;
  HostLoop loop(std::make_unique<ScriptedDevice>(script));
  LoopState state;
  ASSERT_TRUE(soon([&] { return loop.look(state) && state.timing.ticks > 20; }));
  EXPECT_EQ(state.device.health, Health::Good);
  EXPECT_GT(state.stale, 0U);  // nobody wishes anything
  script.is_plugged = false;
  ASSERT_TRUE(soon([&] { return loop.look(state) && state.device.health == Health::Gone; }));
  ASSERT_TRUE(soon([&] { return !loop.problem().empty(); }));
  script.is_plugged = true;
  ASSERT_TRUE(soon([&] { return loop.look(state) && state.device.health == Health::Good; }));
  EXPECT_EQ(script.opened, 2);
  EXPECT_TRUE(loop.problem().empty());
}

TEST(HostLoop, WhatADeviceCanIsKnownAsSoonAsItHasSaidWhoItIs) {
  // Else a motor arm's calibration, begun on its first sample, would be that of a servo arm.
  Script script;
  script.says.health = Health::Starting;
  HostLoop loop(std::make_unique<ScriptedDevice>(script));
  LoopState state;
  ASSERT_TRUE(soon([&] { return loop.look(state) && state.timing.ticks > 5; }));
  EXPECT_FALSE(state.able.stop);
  script.says_unit = true;
  ASSERT_TRUE(soon([&] { return loop.look(state) && state.device.has_unit; }));
  EXPECT_EQ(state.device.health, Health::Starting);
  EXPECT_TRUE(state.able.stop);
}

TEST(TimeHistogram, TellsTimesToThreeInAHundred) {
  TimeHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0);
  for (int i = 1; i <= 10000; ++i) histogram.add(i);
  EXPECT_NEAR(histogram.quantile(0.5), 5000, 150);
  EXPECT_NEAR(histogram.quantile(0.999), 9990, 300);
  EXPECT_EQ(histogram.most(), 10000);
  histogram.add(std::nan(""));
  histogram.add(-5);
  EXPECT_EQ(histogram.count(), 10002U);
}

}  // namespace
}  // namespace carpus::devices
