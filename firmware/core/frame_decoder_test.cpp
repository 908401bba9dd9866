// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/frame_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"

namespace carpus::firmware {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Frame>
void append(Bytes& to, const Frame& frame, std::uint8_t sequence) {
  std::uint8_t bytes[kMaxFrameBytes];
  const int length = encode_frame(frame, sequence, bytes);
  to.insert(to.end(), bytes, bytes + length);
}

Stop random_stop(Rng& rng) {
  Stop stop;
  for (LegStop& leg : stop.legs) {
    leg.angle = static_cast<std::int16_t>(static_cast<int>(rng.below(16384)) - 8192);
    leg.side = static_cast<LegStopSide>(rng.below(4));
  }
  return stop;
}

/// Bytes that look like our frames as often as chance makes nothing else do.
std::uint8_t tempting_byte(Rng& rng) {
  constexpr std::uint8_t kTempting[] = {kSync, kSync, 1, 2, 3, 4, 5, 0x81};
  return rng.below(3) == 0 ? static_cast<std::uint8_t>(rng.below(256)) : kTempting[rng.below(8)];
}

TEST(FrameDecoder, SaysHowManyBytesOfAFrameAreMissing) {
  Bytes stream;
  append(stream, Stop{}, 1);
  append(stream, Stop{}, 2);
  DeviceDecoder decoder;
  EXPECT_EQ(decoder.missing(), 255);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    decoder.push(stream[i]);
    const std::size_t in_frame = i % 11 + 1;
    EXPECT_EQ(decoder.next(), in_frame == 11);
    EXPECT_EQ(decoder.missing(), in_frame < 2 || in_frame == 11 ? 255 : 11 - in_frame);
  }
}

TEST(FrameDecoder, FindsEveryFrameInGarbageThatLooksLikeFrames) {
  Rng rng(5);
  for (int round = 0; round < 2000; ++round) {
    Bytes stream;
    Bytes sent;
    const std::size_t frames = 1 + rng.below(6);
    for (std::size_t i = 0; i < frames; ++i) {
      for (std::size_t n = rng.below(60); n > 0; --n) stream.push_back(tempting_byte(rng));
      sent.push_back(static_cast<std::uint8_t>(rng.below(256)));
      append(stream, random_stop(rng), sent.back());
    }
    // A false sync at the end may wait for bytes: a silent line would end it by the watchdog.
    stream.resize(stream.size() + kMaxFrameBytes, 0);
    DeviceDecoder decoder;
    Bytes found;
    for (const std::uint8_t byte : stream) {
      decoder.push(byte);
      while (decoder.next()) {
        Stop stop;
        if (decoder.read_frame(stop)) found.push_back(decoder.sequence());
      }
    }
    ASSERT_EQ(found, sent) << "round " << round;
  }
}

TEST(FrameDecoder, TakesNoFrameWithAnyOneByteBurstOrThreeBitsChanged) {
  Rng rng(6);
  Bytes good;
  append(good, random_stop(rng), 77);
  const auto accepted = [](const Bytes& bytes) {
    DeviceDecoder decoder;
    int count = 0;
    for (const std::uint8_t byte : bytes) {
      decoder.push(byte);
      while (decoder.next()) ++count;
    }
    return count;
  };
  ASSERT_EQ(accepted(good), 1);
  const std::size_t bits = 8 * good.size();
  for (std::size_t a = 0; a < bits; ++a) {
    for (std::size_t b = a; b < bits; ++b) {
      for (std::size_t c = b; c < std::min(bits, b + 24); ++c) {
        Bytes bad = good;
        for (const std::size_t bit : {a, b, c}) {
          bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
        }
        if (bad == good) continue;
        ASSERT_EQ(accepted(bad), 0) << a << " " << b << " " << c;
      }
    }
  }
  // Bits in the order of the line, so a burst may lie across three bytes.
  for (std::size_t first = 0; first + 16 <= bits; ++first) {
    for (unsigned burst = 1; burst < 65536; burst += 2) {
      Bytes bad = good;
      for (std::size_t i = 0; i < 16; ++i) {
        if ((burst >> i & 1U) == 0) continue;
        const std::size_t bit = first + i;
        bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
      }
      if (bad[0] != kSync || bad[1] != 4) continue;  // then no frame begins here, or another kind
      ASSERT_EQ(accepted(bad), 0) << "burst " << burst << " at " << first;
    }
  }
}

TEST(FrameDecoder, ManyFramesInOneReadAreAllThere) {
  Bytes stream;
  for (int i = 0; i < 100; ++i) append(stream, Contact{}, static_cast<std::uint8_t>(i));
  DeviceDecoder decoder;
  int found = 0;
  for (const std::uint8_t byte : stream) {
    decoder.push(byte);
    while (decoder.next()) EXPECT_EQ(decoder.sequence(), found++);
  }
  EXPECT_EQ(found, 100);
  EXPECT_EQ(decoder.refused(), 0);
}

}  // namespace
}  // namespace carpus::firmware
