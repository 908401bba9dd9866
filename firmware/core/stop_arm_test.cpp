// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/stop_arm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/rng.hpp"

namespace carpus::firmware {
namespace {

constexpr int kGap = 410;  // 9 degrees

/// An arm with its host and its legs' potentiometers; 1248 us a sample, a frame of the host each 1
/// ms.
struct Rig {
  StopArm arm{42};
  std::uint32_t now_us = 0;
  std::uint8_t sequence = 0;
  std::uint16_t counts[3] = {2000, 2000, 2000};
  std::uint32_t next_frame_us = 0;
  std::uint32_t next_servo_us = 0;
  Stop wish;
  bool host_is_silent = false;
  bool repeats = false;
  std::vector<Sensors> answers;

  template <typename Frame>
  void send(const Frame& frame) {
    if (!repeats) ++sequence;
    std::uint8_t bytes[kMaxFrameBytes];
    const int length = encode_frame(frame, sequence, bytes);
    for (int i = 0; i < length; ++i) arm.take(bytes[i], now_us);
    std::uint8_t reply[kMaxDeviceFrameBytes];
    const int answer = arm.reply(reply, now_us);
    HostDecoder decoder;
    for (int i = 0; i < answer; ++i) decoder.push(reply[i]);
    Sensors sensors;
    if (decoder.next() && decoder.read_frame(sensors)) answers.push_back(sensors);
  }
  void greet() {
    send(Hello{kProtocolVersion});
    configure();
  }
  void configure() {
    for (std::uint8_t leg = 0; leg < 3; ++leg) {
      LegConfig config;
      config.leg = leg;
      config.zero_counts = 2000;
      config.gain = 15473;
      config.pulse_at_zero_us = 1500;
      config.pulse_per_turn_us = 2000;
      config.gap = kGap;
      config.least_pulse_us = 1000;
      config.most_pulse_us = 2000;
      send(config);
    }
  }
  void run_ms(double ms) {
    const auto end = now_us + static_cast<std::uint32_t>(ms * 1000);
    while (now_us < end) {
      now_us += kSamplePeriodUs;
      if (!host_is_silent && now_us >= next_frame_us) {
        send(wish);
        next_frame_us = now_us + 1000;
      }
      const bool is_frame = now_us >= next_servo_us;
      if (is_frame) next_servo_us = now_us + 20000;
      for (std::uint8_t leg = 0; leg < 3; ++leg) {
        arm.sample(leg, counts[leg], now_us);
        arm.step(leg, now_us);
        if (is_frame && arm.pulse_half_us(leg) != 0) arm.sent(leg);
      }
    }
  }
  /// Of the horn's middle [pi/8192 rad], from the pulse.
  [[nodiscard]] double horn(std::uint8_t leg) const {
    return (arm.pulse_half_us(leg) / 2.0 - 1500.0) * 8192.0 / 2000.0;
  }
};

TEST(StopArm, DrivesNothingBeforeItIsGreetedConfiguredAndAskedThrice) {
  Rig rig;
  rig.run_ms(100);
  EXPECT_FALSE(rig.arm.is_driving()) << "stops alone move nothing";
  EXPECT_TRUE(rig.answers.back().status & kStatusAfterReset);
  rig.send(Hello{kProtocolVersion});
  rig.run_ms(100);
  EXPECT_FALSE(rig.arm.is_driving()) << "not configured";
  rig.configure();
  rig.run_ms(100);
  EXPECT_TRUE(rig.arm.is_driving());
  EXPECT_EQ(rig.answers.back().status, kStatusConfigured | kStatusDriving);
}

TEST(StopArm, AnUnknownHostsFramesDoNotTakeEffectBeforeThreeInARow) {
  Rig rig;
  rig.greet();
  rig.run_ms(60);
  rig.host_is_silent = true;
  rig.run_ms(60);
  EXPECT_FALSE(rig.arm.is_driving());
  for (int i = 1; i <= 3; ++i) {
    rig.send(rig.wish);
    for (std::uint8_t leg = 0; leg < 3; ++leg) rig.arm.step(leg, rig.now_us);
    EXPECT_EQ(rig.arm.is_driving(), i == 3);
  }
}

TEST(StopArm, SilenceTakesTheServosOffWithin25Ms) {
  for (const bool repeats : {false, true}) {
    Rig rig;
    rig.greet();
    rig.run_ms(100);
    ASSERT_TRUE(rig.arm.is_driving());
    if (repeats) {
      rig.repeats = true;  // the last frame over and over is silence too
    } else {
      rig.host_is_silent = true;
    }
    rig.run_ms(23);
    EXPECT_TRUE(rig.arm.is_driving());
    rig.run_ms(3);
    EXPECT_FALSE(rig.arm.is_driving());
    rig.repeats = false;
    rig.host_is_silent = false;
    rig.run_ms(10);
    EXPECT_TRUE(rig.arm.is_driving()) << "and comes back by itself";
  }
}

TEST(StopArm, ABrokenOrUnpluggedSensorTakesThemOffWithin5Ms) {
  for (const std::uint16_t rail : {std::uint16_t{0}, kMostCounts}) {
    Rig rig;
    rig.greet();
    rig.run_ms(100);
    rig.counts[1] = rail;
    rig.run_ms(4);
    EXPECT_FALSE(rig.arm.is_driving());
    rig.run_ms(1);
    EXPECT_TRUE(rig.answers.back().status & kStatusSensorFault);
    rig.counts[1] = 2000;
    rig.run_ms(60);
    EXPECT_TRUE(rig.arm.is_driving());
    EXPECT_FALSE(rig.answers.back().status & kStatusSensorFault);
  }
}

TEST(StopArm, ABounceOfTheWiperIsNoFault) {
  Rig rig;
  rig.greet();
  rig.run_ms(100);
  const double before = rig.horn(0);
  rig.counts[0] = 3000;
  rig.run_ms(1.2);
  rig.counts[0] = 2000;
  rig.run_ms(1.2);
  EXPECT_TRUE(rig.arm.is_driving());
  EXPECT_NEAR(rig.horn(0), before, 2.0);
}

TEST(StopArm, InFreeSpaceTheSlotFollowsTheLegAndInMotionLeadsIt) {
  Rig rig;
  rig.greet();
  rig.run_ms(200);
  for (int i = 0; i < 160; ++i) {
    ++rig.counts[0];
    rig.run_ms(1.248);
  }
  const double leg = (rig.counts[0] - 2000) * 15473.0 / 4096.0;
  const double rate = 15473.0 / 4096.0;  // a sample
  EXPECT_NEAR(rig.horn(0), leg + rate * kLeadSamples, 25);
  EXPECT_NEAR(rig.horn(1), 0, 2);
}

TEST(StopArm, TheSlotsEdgeStandsOnTheWallFromEitherSide) {
  for (const bool below : {true, false}) {
    Rig rig;
    rig.greet();
    rig.run_ms(100);
    const std::int16_t wall = below ? -50 : 50;
    for (LegStop& leg : rig.wish.legs) {
      leg.angle = wall;
      leg.side = below ? LegStopSide::NotBelow : LegStopSide::NotAbove;
    }
    rig.run_ms(300);
    EXPECT_NEAR(rig.horn(0) + (below ? -kGap : kGap), wall, 3);
    // Pressed a little it stands.
    rig.counts[0] = static_cast<std::uint16_t>(2000 + (below ? -20 : 20));
    rig.run_ms(300);
    EXPECT_NEAR(rig.horn(0) + (below ? -kGap : kGap), wall, 3);
    // Pressed hard it gives way.
    rig.counts[0] = static_cast<std::uint16_t>(2000 + (below ? -100 : 100));
    rig.run_ms(300);
    EXPECT_TRUE(rig.answers.back().status & kStatusLimited);
    EXPECT_GT(std::abs(rig.horn(0) + (below ? -kGap : kGap) - wall), 100);
  }
}

TEST(StopArm, AStopNeverPushesAHandFasterThan45DegreesASecond) {
  Rig rig;
  rig.greet();
  rig.run_ms(300);
  rig.wish.legs[0].side = LegStopSide::NotBelow;
  rig.wish.legs[0].angle = 1500;  // far beyond where the leg is
  double before = rig.horn(0);
  for (int frame = 0; frame < 30; ++frame) {
    rig.run_ms(20);
    EXPECT_LE(rig.horn(0) - before, 2.0 * kMostPushStep / 2.0 * 8192 / 2000 + 1);
    before = rig.horn(0);
  }
  EXPECT_LE(rig.horn(0) - kGap, kMostPress + 3) << "and gives way before it has gone far";
}

TEST(StopArm, PulsesStayInTheirLimitsWhateverComes) {
  Rng rng(9);
  Rig rig;
  rig.greet();
  int driving = 0;
  for (int i = 0; i < 4000; ++i) {
    if (rng.below(10) == 0) {
      for (LegStop& leg : rig.wish.legs) {
        leg.angle = static_cast<std::int16_t>(static_cast<int>(rng.below(16384)) - 8192);
        leg.side = static_cast<LegStopSide>(rng.below(3));
      }
    }
    for (std::uint16_t& c : rig.counts) {
      c = static_cast<std::uint16_t>(
          std::clamp<int>(c + static_cast<int>(rng.below(61)) - 30, 50, 4040));
    }
    rig.run_ms(1);
    driving += rig.arm.is_driving() ? 1 : 0;
    for (std::uint8_t leg = 0; leg < 3; ++leg) {
      const int pulse = rig.arm.pulse_half_us(leg);
      if (pulse == 0) continue;
      ASSERT_GE(pulse, 2000);
      ASSERT_LE(pulse, 4000);
    }
  }
  EXPECT_GT(driving, 3000);
}

TEST(StopArm, AServoThatIsPressedForLongIsLetGoAndRestsUntilCool) {
  Rig rig;
  rig.greet();
  rig.run_ms(100);
  rig.wish.legs[0].side = LegStopSide::NotBelow;
  rig.wish.legs[0].angle = 150;  // pressed 3.3 degrees
  rig.run_ms(5000);
  EXPECT_TRUE(rig.arm.is_driving());
  rig.run_ms(25000);
  EXPECT_FALSE(rig.arm.is_driving());
  EXPECT_TRUE(rig.answers.back().status & kStatusHot);
  rig.wish.legs[0].side = LegStopSide::Free;
  rig.run_ms(20000);
  EXPECT_TRUE(rig.arm.is_driving());
}

TEST(StopArm, AnOldFrameChangesNothing) {
  Rig rig;
  rig.greet();
  rig.run_ms(200);
  const std::size_t answered = rig.answers.size();
  Stop old;
  old.legs[0].angle = 400;
  old.legs[0].side = LegStopSide::NotBelow;
  const std::uint8_t now = rig.sequence;
  rig.sequence = static_cast<std::uint8_t>(now - 2);
  rig.send(old);
  EXPECT_EQ(rig.answers.size(), answered) << "not even answered";
  rig.sequence = now;
  rig.run_ms(20);
  EXPECT_NEAR(rig.horn(0), 0, 3);
}

TEST(StopArm, ConfigurationIsRefusedWhileItDrives) {
  Rig rig;
  rig.greet();
  rig.run_ms(200);
  LegConfig config;
  config.gain = -15473;
  config.pulse_at_zero_us = 1200;
  config.pulse_per_turn_us = 2000;
  config.least_pulse_us = 1000;
  config.most_pulse_us = 2000;
  rig.send(config);
  rig.run_ms(100);
  EXPECT_NEAR(rig.horn(0), 0, 3);
}

}  // namespace
}  // namespace carpus::firmware
