// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/latest_value.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

#include "core/spsc_ring.hpp"

namespace carpus {
namespace {

/// Two equal halves: a torn read shows as a difference.
struct Twin {
  std::uint64_t a = 0;
  std::uint64_t b = 0;
};

TEST(LatestValue, ReaderSeesOnlyWholeAndNewerValues) {
  constexpr std::uint64_t kLast = 200'000;
  LatestValue<Twin> latest;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) latest.publish({i, i});
  });
  std::uint64_t seen = 0;
  while (seen < kLast) {
    Twin value;
    if (!latest.take(value)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(value.a, value.b);
    ASSERT_GT(value.a, seen);
    seen = value.a;
  }
  writer.join();
  Twin value;
  EXPECT_FALSE(latest.take(value));
}

TEST(SpscRing, KeepsOrderAcrossThreadsAndRefusesWhenFull) {
  SpscRing<std::uint64_t, 8> ring;
  for (std::uint64_t i = 0; i < 8; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(8));
  for (std::uint64_t i = 0; i < 8; ++i) EXPECT_EQ(ring.pop(), i);
  EXPECT_EQ(ring.pop(), std::nullopt);

  constexpr std::uint64_t kCount = 100'000;
  std::thread producer([&] {
    for (std::uint64_t i = 0; i < kCount;) {
      if (ring.push(i)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (std::uint64_t expected = 0; expected < kCount;) {
    if (const auto value = ring.pop()) {
      ASSERT_EQ(*value, expected++);
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
}

}  // namespace
}  // namespace carpus
