// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/large_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace carpus {
namespace {

using Numbers = std::vector<std::uint32_t, LargePageAllocator<std::uint32_t>>;

TEST(LargePages, HoldWhatOtherMemoryHolds) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{3000000}}) {
    Numbers numbers(count);
    std::iota(numbers.begin(), numbers.end(), 7U);
    for (std::uint32_t i = 0; i < 100000; ++i) numbers.push_back(i);  // moved as it grows
    EXPECT_EQ(numbers[0], 7U);
    EXPECT_EQ(numbers[count - 1], 6U + count);
    EXPECT_EQ(numbers.back(), 99999U);
    const Numbers copy = numbers;
    EXPECT_EQ(copy, numbers);
  }
}

TEST(LargePages, BeginALongArrayOnAPage) {
  const Numbers numbers(3000000);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % (std::uintptr_t{2} << 20U), 0U);
}

TEST(LargePages, AnArrayTooLongIsRefusedAsByTheStandardOne) {
  Numbers numbers;
  EXPECT_THROW(numbers.reserve(numbers.max_size() / 2), std::bad_alloc);
}

}  // namespace
}  // namespace carpus
