// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver on events as the kernel writes them.
#include "devices/gamepad_device.hpp"

#include <gtest/gtest.h>
#include <linux/input.h>

#include "core/error.hpp"
#include "devices/fake_link_test_support.hpp"

namespace carpus::devices {
namespace {

struct Rumbles {
  std::vector<double> shares;
};

class FakeControls final : public GamepadControls {
 public:
  explicit FakeControls(Rumbles& rumbles) : rumbles_(rumbles) {}
  [[nodiscard]] bool range(std::uint16_t axis, Range& out) const noexcept override {
    if (axis == ABS_Z || axis == ABS_RZ) out = {0, 255};
    if (axis == ABS_RX) out = {5, 5};  // a kernel that says nonsense
    return axis != ABS_RY;
  }
  [[nodiscard]] bool can_rumble() const noexcept override { return true; }
  void rumble(double share) noexcept override { rumbles_.shares.push_back(share); }

 private:
  Rumbles& rumbles_;
};

class Desk {
 public:
  Desk() {
    device = std::make_unique<GamepadDevice>([this] {
      OpenGamepad pad;
      pad.link = fake_opener(line)();
      pad.controls = std::make_unique<FakeControls>(rumbles);
      return pad;
    });
    device->open();
  }
  void say(std::uint16_t type, std::uint16_t code, std::int32_t value) {
    input_event event{};
    event.type = type;
    event.code = code;
    event.value = value;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&event);
    line->to_host.insert(line->to_host.end(), bytes, bytes + sizeof event);
  }
  void report() {
    say(EV_SYN, SYN_REPORT, 0);
    device->poll(now += 8 * kNsPerMs, state);
  }

  std::shared_ptr<FakeLine> line = std::make_shared<FakeLine>();
  Rumbles rumbles;
  std::unique_ptr<GamepadDevice> device;
  DeviceState state;
  Nanoseconds now = 1'000'000'000;
};

TEST(Gamepad, SticksSayHowFastAndButtonsAreBits) {
  Desk desk;
  desk.say(EV_ABS, ABS_X, 32767);
  desk.say(EV_ABS, ABS_Y, 3000);  // worn
  desk.say(EV_KEY, BTN_EAST, 1);
  desk.report();
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_NEAR(desk.state.velocity_mm_s.x, 30, 1e-9);
  EXPECT_EQ(desk.state.velocity_mm_s.y, 0);
  EXPECT_EQ(desk.state.buttons, 2U);
  desk.say(EV_ABS, ABS_X, 0);
  desk.say(EV_ABS, ABS_RZ, 255);
  desk.say(EV_KEY, BTN_EAST, 0);
  desk.report();
  EXPECT_EQ(desk.state.velocity_mm_s.x, 0);
  EXPECT_NEAR(desk.state.velocity_mm_s.z, 30, 1e-9);
  EXPECT_EQ(desk.state.buttons, 0U);
}

TEST(Gamepad, ValuesOutOfRangeAreNotBelieved) {
  Desk desk;
  desk.say(EV_ABS, ABS_X, 2'000'000'000);
  desk.report();
  EXPECT_EQ(desk.state.velocity_mm_s.x, 0);
  EXPECT_EQ(desk.state.refused, 1U);
}

TEST(Gamepad, WhatTheKernelDroppedIsAtRest) {
  Desk desk;
  desk.say(EV_ABS, ABS_X, 32767);
  desk.say(EV_KEY, BTN_SOUTH, 1);
  desk.report();
  desk.say(EV_SYN, SYN_DROPPED, 0);
  desk.say(EV_ABS, ABS_Y, 32767);
  desk.report();
  EXPECT_EQ(desk.state.velocity_mm_s, Vec3{});
  EXPECT_EQ(desk.state.buttons, 0U);
}

TEST(Gamepad, UnpluggedItLetsGo) {
  Desk desk;
  desk.say(EV_ABS, ABS_X, 32767);
  desk.report();
  desk.line->is_plugged = false;
  desk.device->poll(desk.now, desk.state);
  EXPECT_EQ(desk.state.health, Health::Gone);
  EXPECT_EQ(desk.state.velocity_mm_s, Vec3{});
  EXPECT_THROW(desk.device->open(), IoError);
}

TEST(Gamepad, RumblesAsStronglyAsItIsToldAndSeldom) {
  Desk desk;
  DeviceCommand wish;
  for (int i = 0; i < 100; ++i) {
    wish.vibration_n = i < 99 ? 0.5 + 0.001 * i : 0;
    desk.device->command(desk.now += kNsPerMs, wish);
  }
  ASSERT_GE(desk.rumbles.shares.size(), 3U);
  EXPECT_LE(desk.rumbles.shares.size(), 6U);
  EXPECT_EQ(desk.rumbles.shares.front(), 0.5);
  EXPECT_EQ(desk.rumbles.shares.back(), 0);
  EXPECT_TRUE(desk.device->capabilities().vibration);
  desk.device->close();
  EXPECT_EQ(desk.rumbles.shares.back(), 0);
}

}  // namespace
}  // namespace carpus::devices
