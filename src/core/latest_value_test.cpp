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
    if (!latest.take(value)) continue;
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
    for (std::uint64_t i = 0; i < kCount;) i += ring.push(i) ? 1 : 0;
  });
  for (std::uint64_t expected = 0; expected < kCount;) {
    if (const auto value = ring.pop()) {
      ASSERT_EQ(*value, expected++);
    }
  }
  producer.join();
}

}  // namespace
}  // namespace carpus
