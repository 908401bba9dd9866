// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The program of firmware/avr, as it would be flashed, in simavr: its pulses, its answers, its
// time, what it does when the host is silent, the line is bad, or the supply fails. Virtual time;
// nothing here depends on the machine's speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <map>
#include <vector>

#include "core/rng.hpp"
#include "firmware/avr/simulated_avr.hpp"
#include "firmware/core/frame_decoder.hpp"
#include "firmware/core/stop_arm.hpp"

namespace carpus::firmware {
namespace {

constexpr double kByteUs = 20.0;  // ten bits at 500 kbaud

struct Pulse {
  int leg = 0;
  double begun_us = 0;
  double length_us = 0;
};
struct Answer {
  Sensors sensors;
  double us = 0;
};

/// The board, and a host that sends bytes as its line can.
class Bench {
 public:
  Bench() : avr(CARPUS_ARM_AVR_ELF) {
    avr.on_pulse = [this](int leg, double begun, double length) {
      pulses.push_back({leg, begun, length});
    };
    avr.on_byte = [this](std::uint8_t byte, double us) {
      decoder_.push(byte);
      while (decoder_.next()) {
        Answer answer;
        answer.us = us;
        if (decoder_.read_frame(answer.sensors)) answers.push_back(answer);
        Identity identity;
        if (decoder_.read_frame(identity)) identities.push_back(identity);
      }
    };
    run_ms(50);
  }

  /// Sends bytes one after the other, and runs meanwhile. @return when the first began.
  double send_bytes(const std::vector<std::uint8_t>& bytes) {
    const double begin = avr.now_us();
    double at = begin;
    for (const std::uint8_t byte : bytes) {
      avr.receive(byte);
      at += kByteUs;
      avr.run_to(at);
    }
    return begin;
  }
  template <typename Frame>
  std::vector<std::uint8_t> bytes_of(const Frame& frame) {
    std::vector<std::uint8_t> bytes(kMaxFrameBytes);
    bytes.resize(encode_frame(frame, ++sequence, bytes.data()));
    return bytes;
  }
  template <typename Frame>
  double send(const Frame& frame) {
    return send_bytes(bytes_of(frame));
  }
  void run_ms(double ms) { avr.run_to(avr.now_us() + 1000 * ms); }

  void greet() {
    send(Hello{kProtocolVersion});
    run_ms(1);
    for (std::uint8_t leg = 0; leg < 3; ++leg) {
      LegConfig config;
      config.leg = leg;
      config.zero_counts = 2046;
      config.gain = 15473;
      config.pulse_at_zero_us = 1500;
      config.pulse_per_turn_us = 2000;
      config.gap = 410;
      config.least_pulse_us = 1000;
      config.most_pulse_us = 2000;
      send(config);
      run_ms(1);
    }
  }
  /// Stops at 1 kHz, or at another rate.
  void drive_ms(double ms, const Stop& stop, double period_us = 1000) {
    const double end = avr.now_us() + 1000 * ms;
    while (avr.now_us() < end) {
      const double begin = send(stop);
      avr.run_to(begin + period_us);
    }
  }

  SimulatedAvr avr;
  std::uint8_t sequence = 0;
  std::vector<Pulse> pulses;
  std::vector<Answer> answers;
  std::vector<Identity> identities;

 private:
  HostDecoder decoder_;
};

/// A stop that holds the pulse at one length, for any leg's angle.
Stop still_stop(int angle) {
  Stop stop;
  for (LegStop& leg : stop.legs) {
    leg.side = LegStopSide::NotBelow;
    leg.angle = static_cast<std::int16_t>(angle);
  }
  return stop;
}

TEST(AvrFirmware, SaysWhoItIs) {
  Bench bench;
  EXPECT_TRUE(bench.pulses.empty());
  bench.greet();
  ASSERT_EQ(bench.identities.size(), 1U);
  EXPECT_EQ(bench.identities[0].version, kProtocolVersion);
  EXPECT_EQ(bench.identities[0].drive, static_cast<std::uint8_t>(Drive::Stop));
  bench.run_ms(2);
  ASSERT_EQ(bench.answers.size(), 3U);
  EXPECT_EQ(bench.answers.back().sensors.status, kStatusConfigured);
}

TEST(AvrFirmware, PulsesAreWithinAMicrosecondWhateverElseItDoes) {
  Bench bench;
  bench.greet();
  Rng rng(3);
  double worst = 0;
  std::map<int, int> seen;
  for (const int angle : {-400, -200, 0, 150}) {
    const Stop stop = still_stop(angle);
    bench.drive_ms(250, stop);  // until the pulse has come there
    bench.pulses.clear();
    // Frames at random times, as close as the line can bring them.
    const double end = bench.avr.now_us() + 400e3;
    while (bench.avr.now_us() < end) {
      bench.send(stop);
      bench.avr.run_to(bench.avr.now_us() + rng.uniform(0, 900));
    }
    const double wished =
        std::floor(2 * 1500.0 + (angle + 410) * 2000.0 / 4096) / 2;  // in half microseconds
    ASSERT_GT(bench.pulses.size(), 50U);
    for (const Pulse& pulse : bench.pulses) {
      worst = std::max(worst, std::abs(pulse.length_us - wished));
      ++seen[pulse.leg];
    }
  }
  std::printf("worst error of a servo's pulse: %.2f us\n", worst);
  EXPECT_LE(worst, 1.0);
  EXPECT_EQ(seen.size(), 3U);
}

TEST(AvrFirmware, ThePulsesOfAServoAreAFrameApart) {
  Bench bench;
  bench.greet();
  bench.drive_ms(500, Stop{});
  std::map<int, double> last;
  for (const Pulse& pulse : bench.pulses) {
    if (last.contains(pulse.leg)) {
      EXPECT_NEAR(pulse.begun_us - last[pulse.leg], 20000, 1.5);
    }
    last[pulse.leg] = pulse.begun_us;
  }
  EXPECT_EQ(last.size(), 3U);
}

TEST(AvrFirmware, AnswersAStopWithin700Us) {
  Bench bench;
  bench.greet();
  std::vector<double> trips;
  Rng rng(4);
  for (int i = 0; i < 600; ++i) {
    const std::size_t before = bench.answers.size();
    const double begin = bench.send(Stop{});
    bench.avr.run_to(begin + 1000);
    ASSERT_EQ(bench.answers.size(), before + 1);
    EXPECT_EQ(bench.answers.back().sensors.echo, bench.sequence);
    EXPECT_LT(bench.answers.back().sensors.age_4us, 250);
    trips.push_back(bench.answers.back().us - begin);
    bench.avr.run_to(bench.avr.now_us() + rng.uniform(0, 300));
  }
  std::sort(trips.begin(), trips.end());
  std::printf("round trip of 11 bytes and 14 at 500 kbaud: p50 %.0f us, worst %.0f us\n",
              trips[300], trips.back());
  EXPECT_LE(trips.back(), 700);
}

TEST(AvrFirmware, UsesLessThan60PercentOfTimeFlashAndMemory) {
  Bench bench;
  bench.greet();
  bench.drive_ms(200, still_stop(100));
  bench.avr.count_every_cycle();
  bench.drive_ms(200, still_stop(100));
  std::printf(
      "ATmega328P: %.0f %% of its time, %.0f %% of flash, %.0f %% of memory; at most %.1f us "
      "without interrupts\n",
      100 * bench.avr.share_of_time_used(), 100 * bench.avr.share_of_flash(),
      100 * bench.avr.share_of_ram(), bench.avr.longest_without_interrupts_us());
  EXPECT_LT(bench.avr.share_of_time_used(), 0.6);
  EXPECT_LT(bench.avr.share_of_flash(), 0.6);
  EXPECT_LT(bench.avr.share_of_ram(), 0.6);
  // The USART keeps two bytes: longer, and a third would be lost, which simavr does not show.
  EXPECT_LT(bench.avr.longest_without_interrupts_us(), 2 * kByteUs);
  EXPECT_TRUE(bench.avr.is_supply_on());
}

TEST(AvrFirmware, ASilentHostLosesTheServosWithin25MsAndOneFrame) {
  Bench bench;
  bench.greet();
  bench.drive_ms(200, Stop{});
  ASSERT_TRUE(bench.avr.is_supply_on());
  const double silent = bench.avr.now_us();
  bench.run_ms(26);
  EXPECT_FALSE(bench.avr.is_supply_on());
  bench.run_ms(74);
  for (const Pulse& pulse : bench.pulses) EXPECT_LT(pulse.begun_us, silent + 25e3);
  const std::size_t before = bench.pulses.size();
  bench.drive_ms(100, Stop{});
  EXPECT_GT(bench.pulses.size(), before + 9) << "recovered";
}

TEST(AvrFirmware, ALineThatFallsSilentWithinAFrameHoldsNothingUp) {
  for (const std::size_t bytes : {1, 2, 5, 8, 10}) {
    Bench bench;
    bench.greet();
    bench.drive_ms(100, Stop{});
    std::vector<std::uint8_t> begun = bench.bytes_of(Stop{});
    begun.resize(bytes);
    bench.send_bytes(begun);
    ASSERT_TRUE(bench.avr.is_supply_on());
    bench.run_ms(26.5);
    EXPECT_FALSE(bench.avr.is_supply_on()) << bytes << " bytes";
  }
}

TEST(AvrFirmware, ABadLineNeverMakesAWrongPulse) {
  Bench bench;
  bench.greet();
  Rng rng(11);
  const Stop stop = still_stop(0);
  bench.drive_ms(300, stop);
  bench.pulses.clear();
  const std::size_t before = bench.answers.size();
  int sent = 0;
  std::deque<std::vector<std::uint8_t>> late;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes = bench.bytes_of(stop);
    const double begin = bench.avr.now_us();
    switch (rng.below(100)) {
      case 0:  // a burst
        for (std::size_t n = 1 + rng.below(4), at = rng.below(bytes.size()); n > 0; --n) {
          bytes[(at + n) % bytes.size()] = static_cast<std::uint8_t>(rng.below(256));
        }
        break;
      case 1:
        bytes.clear();
        break;
      case 2:
        bytes.insert(bytes.end(), bytes.begin(), bytes.end());
        break;
      case 3:
        late.push_back(bytes);
        bytes.clear();
        break;
      case 4:
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(rng.below(bytes.size())));
        break;
      default:
        ++sent;
    }
    bench.send_bytes(bytes);
    if (!late.empty() && rng.below(2) == 0) {
      bench.send_bytes(late.front());
      late.pop_front();
    }
    bench.avr.run_to(begin + 1000);
  }
  ASSERT_GT(bench.pulses.size(), 290U);
  for (const Pulse& pulse : bench.pulses)
    EXPECT_NEAR(pulse.length_us, 1500 + 410.0 * 1000 / 4096, 1.5);
  EXPECT_GE(bench.answers.size() - before, static_cast<std::size_t>(0.99 * sent));
}

TEST(AvrFirmware, ASensorAtTheRailStopsItWithin5Ms) {
  Bench bench;
  bench.greet();
  bench.drive_ms(200, Stop{});
  bench.avr.set_wiper_mv(2, 5000);
  bench.drive_ms(5, Stop{});
  EXPECT_FALSE(bench.avr.is_supply_on());
  EXPECT_TRUE(bench.answers.back().sensors.status & kStatusSensorFault);
  bench.avr.set_wiper_mv(2, 2500);
  bench.drive_ms(100, Stop{});
  EXPECT_TRUE(bench.avr.is_supply_on()) << "recovered";
}

TEST(AvrFirmware, AfterABrownOutItWaitsUntilTheHostHasSeenIt) {
  Bench bench;
  bench.greet();
  bench.drive_ms(200, Stop{});
  bench.avr.brown_out();
  const std::size_t before = bench.pulses.size();
  bench.drive_ms(200, Stop{});
  EXPECT_EQ(bench.pulses.size(), before);
  EXPECT_TRUE(bench.answers.back().sensors.status & kStatusAfterReset);
  bench.greet();
  bench.drive_ms(200, Stop{});
  EXPECT_GT(bench.pulses.size(), before + 20);
}

TEST(AvrFirmware, IsTheSameInEveryRun) {
  const auto run = [] {
    Bench bench;
    bench.greet();
    bench.avr.set_wiper_mv(0, 2600);
    bench.drive_ms(100, Stop{});
    double sum = 0;
    for (const Answer& answer : bench.answers) sum += answer.us + answer.sensors.legs[0].counts;
    for (const Pulse& pulse : bench.pulses) sum += pulse.begun_us + pulse.length_us;
    return sum;
  };
  const double first = run();
  EXPECT_EQ(first, run());
}

}  // namespace
}  // namespace carpus::firmware
