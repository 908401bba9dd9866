// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver against a Falcon that is played here by its published frames and geometry.
#include "devices/falcon_device.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "devices/fake_link_test_support.hpp"
#include "devices/trusted_state.hpp"

namespace carpus::devices {
namespace {

/// Answers each frame with one of its own, and keeps what it was told.
class FakeFalcon {
 public:
  explicit FakeFalcon(std::shared_ptr<FakeLine> line) : line_(std::move(line)) {}
  void step() {
    while (line_->to_device.size() >= kFalconFrameBytes) {
      FalconSays told;
      FalconFrame frame;
      std::copy_n(line_->to_device.begin(), kFalconFrameBytes, frame.begin());
      line_->to_device.erase(line_->to_device.begin(),
                             line_->to_device.begin() + kFalconFrameBytes);
      ASSERT_TRUE(read_falcon(frame, told));
      motors = told.counts;
      FalconFrame answer = falcon_frame(counts, 0);
      answer[13] = static_cast<std::uint8_t>('A' + (homed << 4 | buttons));
      line_->to_host.insert(line_->to_host.end(), answer.begin(), answer.end());
    }
  }
  void put(const Vec3& tip) {
    const auto angles = falcon_inverse(tip);
    for (std::size_t i = 0; i < 3; ++i) counts[i] = falcon_counts((*angles)[i]);
  }
  std::array<std::int16_t, 3> counts{};
  std::array<std::int16_t, 3> motors{};
  int homed = 7;
  int buttons = 0;

 private:
  std::shared_ptr<FakeLine> line_;
};

class Desk {
 public:
  Desk() : line(std::make_shared<FakeLine>()), falcon(line), device(fake_opener(line)) {
    falcon.put(kFalconCentre);
    device.open();
  }
  void run_ms(int ms, const DeviceCommand& wish = {}) {
    for (int i = 0; i < ms; ++i) {
      now += kNsPerMs;
      device.command(now, wish);
      falcon.step();
      device.poll(now, state);
    }
  }
  std::shared_ptr<FakeLine> line;
  FakeFalcon falcon;
  FalconDevice device;
  DeviceState state;
  Nanoseconds now = 1'000'000'000;
};

TEST(FalconArm, ForwardUndoesInverse) {
  for (double x = -40; x <= 40; x += 20) {
    for (double y = -40; y <= 40; y += 20) {
      for (double z = 85; z <= 145; z += 15) {
        const auto angles = falcon_inverse({x, y, z});
        if (!angles) continue;
        const auto tip = falcon_forward(*angles, kFalconCentre);
        ASSERT_TRUE(tip.has_value()) << x << " " << y << " " << z;
        EXPECT_LT(distance(*tip, {x, y, z}), 1e-5);
      }
    }
  }
  EXPECT_FALSE(falcon_inverse({0, 0, 400}).has_value());
}

TEST(FalconArm, TorquesAreThoseOfVirtualWork) {
  const Vec3 tip{10, -15, 120};
  const auto angles = falcon_inverse(tip);
  ASSERT_TRUE(angles.has_value());
  const Vec3 force{1, -2, 3};
  const auto torques = falcon_torques(tip, *angles, force);
  for (const Vec3& move : {Vec3{1e-4, 0, 0}, Vec3{0, 1e-4, 0}, Vec3{0, 0, 1e-4}}) {
    const auto there = falcon_inverse(tip + move);
    double work = 0;
    for (std::size_t i = 0; i < 3; ++i) work += (*torques)[i] * ((*there)[i] - (*angles)[i]);
    EXPECT_NEAR(work, dot(force, move), 1e-7);
  }
}

TEST(Falcon, FramesAreAsPublished) {
  const FalconFrame frame = falcon_frame({0x1234, -1, 0}, 0x06);
  EXPECT_EQ(std::string(frame.begin(), frame.end()), "<EDCBPPPPAAAAGA>");
  FalconSays says;
  ASSERT_TRUE(read_falcon(frame, says));
  EXPECT_EQ(says.counts[0], 0x1234);
  EXPECT_EQ(says.counts[1], -1);
}

TEST(Falcon, SaysWhereItIsOnceItIsHomed) {
  Desk desk;
  desk.falcon.homed = 3;
  desk.run_ms(20);
  EXPECT_EQ(desk.state.health, Health::Uncalibrated);
  desk.falcon.homed = 7;
  desk.falcon.put(kFalconCentre + Vec3{10, 5, -20});
  desk.falcon.buttons = 5;
  desk.run_ms(20);
  EXPECT_EQ(desk.state.health, Health::Good);
  EXPECT_LT(distance(desk.state.position_mm, {10, 20, 5}), 0.1);
  EXPECT_EQ(desk.state.buttons, 5U);
}

TEST(Falcon, AWallPushesOut) {
  Desk desk;
  desk.run_ms(10);
  DeviceCommand wall;
  wall.plane_count = 1;
  wall.planes[0] = {{0, 0, 1}, 2, 1.0, 0, 0};  // 2 mm above: pressed in by 2 mm
  wall.limit_n = 5;
  desk.run_ms(10, wall);
  EXPECT_NEAR(desk.state.force_n.z, 2, 0.1);
  const auto angles = falcon_inverse(kFalconCentre);
  const auto torques = falcon_torques(kFalconCentre, *angles, {0, 2, 0});  // up in its own axes
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(desk.falcon.motors[i], -10 * (*torques)[i], 30);
  }
  desk.run_ms(5);
  EXPECT_EQ(desk.falcon.motors, (std::array<std::int16_t, 3>{}));
}

TEST(Falcon, ALeapThatNoHandMakesIsRefusedAndLetsGo) {
  Desk desk;
  desk.run_ms(50);
  desk.falcon.put(kFalconCentre + Vec3{0, 30, 20});
  desk.run_ms(1);
  EXPECT_TRUE(is_sound(desk.state)) << length(desk.state.velocity_mm_s) << " mm/s";
  EXPECT_EQ(desk.state.health, Health::Faulty);
  EXPECT_EQ(desk.state.refused, 1U);
  EXPECT_EQ(length(desk.state.velocity_mm_s), 0);
  desk.run_ms(1);
  EXPECT_EQ(desk.state.health, Health::Good) << "it goes on from where it is";
  EXPECT_EQ(length(desk.state.velocity_mm_s), 0);
  EXPECT_GT(length(desk.state.position_mm), 30);
}

TEST(Falcon, SilenceUnpluggingAndGarbage) {
  Desk desk;
  desk.run_ms(10);
  for (int i = 0; i < 120; ++i) {
    desk.now += kNsPerMs;
    desk.device.command(desk.now, {});
    desk.device.poll(desk.now, desk.state);
  }
  EXPECT_EQ(desk.state.health, Health::Silent);
  Rng rng(9);
  for (int i = 0; i < 20000; ++i) {
    const auto byte = static_cast<std::uint8_t>(rng.next() >> 50);
    desk.line->to_host.push_back(i % 16 == 0 ? '<' : (i % 16 == 15 ? '>' : byte));
    desk.device.poll(desk.now, desk.state);
    ASSERT_TRUE(is_finite(desk.state.position_mm));
    ASSERT_LT(length(desk.state.position_mm), 121);
  }
  EXPECT_GT(desk.state.refused, 100U);
  desk.line->to_host.clear();
  desk.run_ms(100);
  EXPECT_EQ(desk.state.health, Health::Good);
  desk.line->is_plugged = false;
  desk.device.poll(desk.now, desk.state);
  EXPECT_EQ(desk.state.health, Health::Gone);
}

}  // namespace
}  // namespace carpus::devices
