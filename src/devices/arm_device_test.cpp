// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver of our arm against the firmware's own core, on a clock that the test moves.
#include "devices/arm_device.hpp"

#include <gtest/gtest.h>

#include "core/allocation_test_support.hpp"
#include "core/counting_new_test_support.hpp"
#include "core/rng.hpp"
#include "devices/fake_arm_test_support.hpp"

namespace carpus::devices {
namespace {

using firmware::Drive;

constexpr std::uint32_t kUnit = 7;

template <typename Fake>
class Desk {
 public:
  explicit Desk(Drive drive, bool is_calibrated = true)
      : line(std::make_shared<FakeLine>()), fake(line, kUnit) {
    if (is_calibrated) store(fake_calibration(drive, kUnit), folder.path());
    device = std::make_unique<ArmDevice>(fake_opener(line), folder.path());
    device->open();
  }
  void run_ms(int ms, const DeviceCommand& wish = {}) {
    for (int i = 0; i < ms; ++i) {
      now += kNsPerMs;
      fake.step(now);
      device->poll(now, state);
      device->command(now, wish);
    }
  }
  void put(const Vec3& place) { fake.put(*arm::inverse(arm_, place + arm_.centre)); }

  TemporaryFolder folder;
  std::shared_ptr<FakeLine> line;
  Fake fake;
  std::unique_ptr<ArmDevice> device;
  DeviceState state;
  Nanoseconds now = 5'000'000'000;

 private:
  arm::DeltaArm arm_;
};

DeviceCommand wall(const Vec3& normal, double offset) {
  DeviceCommand command;
  command.plane_count = 1;
  command.planes[0] = {normal, offset, 2.0, 0.002, 0.2};
  command.limit_n = 4;
  return command;
}

TEST(ArmDevice, SaysWhereTheTipOfDriveAIs) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.put({10, -20, 5});
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_LT(distance(desk.state.position_mm, {10, -20, 5}), 0.3);  // a count is 0.1 mm
  EXPECT_LT(length(desk.state.velocity_mm_s), 1);
  EXPECT_TRUE(desk.device->capabilities().stop);
  EXPECT_FALSE(desk.device->capabilities().force);
  EXPECT_GT(desk.state.samples, 50U);
}

TEST(ArmDevice, SaysWhereTheTipOfDriveBIsWhateverTurnItsMotorsAreIn) {
  Desk<FakeMotorArm> desk(Drive::Motor);
  desk.put({2, 3, -4});
  desk.run_ms(200);
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_LT(distance(desk.state.position_mm, {2, 3, -4}), 0.02);
  EXPECT_TRUE(desk.device->capabilities().force);
}

TEST(ArmDevice, DriveBIsHomedInItsCradleAndStaysSoWhenItsLineIsOpenedAnew) {
  Desk<FakeMotorArm> desk(Drive::Motor);
  desk.put({0, 0, 0});
  desk.run_ms(100);
  for (int i = 0; i <= 40; ++i) {  // farther than half a turn of a motor
    desk.put({0, 0, -1.0 * i});
    desk.run_ms(10);
  }
  EXPECT_NEAR(desk.state.position_mm.z, -40, 0.1);
  desk.device->open();
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_NEAR(desk.state.position_mm.z, -40, 0.1);
}

TEST(ArmDevice, AWallOfDriveBPushesOutAndNeverBeyondTheLimit) {
  Desk<FakeMotorArm> desk(Drive::Motor);
  desk.put({0, 0, 2});
  desk.run_ms(300, wall({0, 0, 1}, 0));
  EXPECT_LT(length(desk.state.force_n), 0.02);  // but for the arm's weight
  for (int i = 1; i <= 40; ++i) {
    desk.put({0, 0, 2 - 0.1 * i});
    desk.run_ms(5, wall({0, 0, 1}, 0));
  }
  EXPECT_GT(desk.state.force_n.z, 1.0);
  EXPECT_LE(length(desk.state.force_n), 4.01);
  EXPECT_LT(std::abs(desk.state.force_n.x), 0.2);
  desk.run_ms(30);  // nothing is wished
  EXPECT_LT(length(desk.state.force_n), 0.02);
}

TEST(ArmDevice, AWallOfDriveAIsStopsThatTheFirmwareTakes) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.put({0, 0, 1});
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Good);
  desk.run_ms(200, wall({0, 0, 1}, 0));
  EXPECT_TRUE(desk.fake.arm.is_driving());
  // Pressed far into the wall the firmware gives way and says so.
  for (int i = 0; i < 100; ++i) {
    desk.put({0, 0, 1 - 0.1 * i});
    desk.run_ms(3, wall({0, 0, 1}, 0));
  }
  EXPECT_EQ(desk.state.health, Health::HoldingBack);
}

TEST(ArmDevice, WithoutACalibrationItSaysSoAndStillShowsItsCounts) {
  Desk<FakeStopArm> desk(Drive::Stop, false);
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Uncalibrated);
  EXPECT_EQ(desk.state.raw_counts[1], 2046);
  EXPECT_FALSE(desk.fake.arm.is_driving());
}

TEST(ArmDevice, ACalibrationOfAnotherUnitIsNotTaken) {
  Desk<FakeStopArm> desk(Drive::Stop, false);
  store(fake_calibration(Drive::Stop, kUnit + 1), desk.folder.path());
  store(fake_calibration(Drive::Motor, kUnit), desk.folder.path());
  desk.device->open();
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Uncalibrated);
}

TEST(ArmDevice, SilentUnpluggedAndBackAgain) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.run_ms(100);
  ASSERT_EQ(desk.state.health, Health::Good);
  for (int i = 0; i < 60; ++i) {  // the firmware hangs
    desk.now += kNsPerMs;
    desk.device->poll(desk.now, desk.state);
    desk.device->command(desk.now, {});
  }
  EXPECT_EQ(desk.state.health, Health::Silent);
  desk.line->is_plugged = false;
  desk.device->poll(desk.now, desk.state);
  EXPECT_EQ(desk.state.health, Health::Gone);
  EXPECT_THROW(desk.device->open(), IoError);
  desk.line->is_plugged = true;
  desk.line->to_device.clear();
  desk.device->open();
  desk.run_ms(150);
  EXPECT_EQ(desk.state.health, Health::Good);
}

TEST(ArmDevice, AfterAResetOfTheBoardItBeginsAnewByItself) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.run_ms(100);
  ASSERT_EQ(desk.state.health, Health::Good);
  desk.fake.arm = firmware::StopArm(kUnit);
  bool has_noticed = false;
  for (int i = 0; i < 200; ++i) {
    desk.run_ms(1);
    has_noticed = has_noticed || desk.state.health == Health::Starting;
  }
  EXPECT_TRUE(has_noticed);
  EXPECT_EQ(desk.state.health, Health::Good);
}

TEST(ArmDevice, ABrokenSensorIsAFaultAndNoPlace) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.run_ms(100);
  const std::uint64_t before = desk.state.samples;
  desk.fake.counts[2] = 4092;
  desk.run_ms(30);
  EXPECT_EQ(desk.state.health, Health::Faulty);
  EXPECT_LE(desk.state.samples, before + 5);
}

TEST(ArmDevice, AnglesThatCannotBeAreNoPlace) {
  Desk<FakeMotorArm> desk(Drive::Motor);
  desk.put({0, 0, 0});
  desk.run_ms(100);
  ASSERT_EQ(desk.state.health, Health::Good);
  desk.fake.counts[0] += 20 * kCountsOfTurn;
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Faulty);
  EXPECT_TRUE(is_finite(desk.state.position_mm));
}

TEST(ArmDevice, GarbageOnTheLineIsCountedAndNothingElse) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.put({3, 3, 3});
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    for (int k = 0; k < 20; ++k) {
      desk.line->to_host.push_back(static_cast<std::uint8_t>(rng.next() >> 24));
    }
    desk.run_ms(1);
    ASSERT_TRUE(is_finite(desk.state.position_mm));
  }
  desk.run_ms(50);
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_LT(distance(desk.state.position_mm, {3, 3, 3}), 0.3);
  EXPECT_GT(desk.state.refused, 10U);
}

TEST(ArmDevice, AFullLineIsCountedAndNeverWaitedFor) {
  Desk<FakeStopArm> desk(Drive::Stop);
  desk.run_ms(100);
  desk.line->is_full = true;
  desk.run_ms(60);
  EXPECT_GT(desk.state.unsent, 50U);
  EXPECT_EQ(desk.state.health, Health::Silent);
}

TEST(ArmDevice, NothingIsAllocatedFromHelloToWall) {
  Desk<FakeStopArm> desk(Drive::Stop);
  int allocations = 0;
  for (int i = 0; i < 300; ++i) {
    desk.now += kNsPerMs;
    desk.fake.step(desk.now);
    desk.line->to_device.reserve(256);
    test::start_counting_allocations();
    desk.device->poll(desk.now, desk.state);
    desk.device->command(desk.now, wall({0, 0, 1}, 0));
    allocations += test::stop_counting_allocations();
  }
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_EQ(allocations, 0);
}

TEST(ArmDevice, AnotherVersionOfTheWireIsAFault) {
  Desk<FakeStopArm> desk(Drive::Stop);
  firmware::Identity identity;
  identity.version = firmware::kProtocolVersion + 1;
  std::uint8_t bytes[firmware::kMaxFrameBytes];
  const std::uint8_t count = firmware::encode_frame(identity, 1, bytes);
  desk.line->to_host.insert(desk.line->to_host.end(), bytes, bytes + count);
  desk.device->poll(desk.now, desk.state);
  EXPECT_EQ(desk.state.health, Health::Faulty);
}

}  // namespace
}  // namespace carpus::devices
