// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/ssi_angle.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace carpus::firmware {
namespace {

std::uint32_t word_of(int counts, std::uint32_t state = 0) {
  const std::uint32_t said = (static_cast<std::uint32_t>(counts) & 0x3FFFU) << 4 | state;
  return said << 6 | crc6(said);
}

TEST(SsiAngle, ChecksumFindsEveryBitAndEveryPairThatIsTurned) {
  const std::uint32_t good = word_of(11111);
  for (int i = 0; i < 24; ++i) {
    for (int k = i; k < 24; ++k) {
      const std::uint32_t bad = good ^ (1U << i) ^ (k == i ? 0U : 1U << k);
      EXPECT_NE(crc6(bad >> 6), bad & 0x3FU) << i << ' ' << k;
    }
  }
}

TEST(TurnCounter, GoesOnOverTheEndOfATurnBothWays) {
  TurnCounter counter;
  int at = 16000;
  ASSERT_EQ(counter.take(word_of(at)), at);
  for (int i = 0; i < 200; ++i) ASSERT_EQ(counter.take(word_of(at += 700)), at);
  for (int i = 0; i < 500; ++i) ASSERT_EQ(counter.take(word_of(at -= 613)), at);
}

TEST(TurnCounter, ADamagedWordDoesNotCountAndALostMagnetIsNowhere) {
  TurnCounter counter;
  ASSERT_EQ(counter.take(word_of(100)), 100);
  EXPECT_EQ(counter.take(word_of(9000) ^ 0x400U), 100);
  EXPECT_EQ(counter.take(word_of(103)), 103);
  int far = 0;
  std::int32_t last = 103;
  for (int i = 0; i < 40; ++i) {
    const std::int32_t counts = counter.take(word_of(103, 0x8));
    if (i < TurnCounter::kMostBad) {
      EXPECT_EQ(counts, 103);
    } else if (counts - last > 1000 || last - counts > 1000) {
      ++far;
    }
    last = counts;
  }
  EXPECT_EQ(far, 40 - TurnCounter::kMostBad) << "each step jumps, so that the core never trusts it";
  EXPECT_EQ(counter.take(word_of(110)), 110);
}

}  // namespace
}  // namespace carpus::firmware
