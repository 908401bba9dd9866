// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/cycle_clock.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

namespace carpus::bench {

CycleClock::CycleClock() {
  using Clock = std::chrono::steady_clock;
  constexpr auto kCalibration = std::chrono::milliseconds(20);
  const auto start = Clock::now();
  const std::uint64_t first = now();
  while (Clock::now() - start < kCalibration) {
  }
  const std::uint64_t last = now();
  const std::chrono::duration<double> passed = Clock::now() - start;
  seconds_per_count_ = passed.count() / static_cast<double>(last - first);

  // Some processors' counters advance in steps of many counts, so that the mean tells more than
  // the median; what an interrupt lengthened is left out.
  constexpr int kSamples = 4001;
  constexpr int kKept = 3600;
  std::vector<std::uint64_t> empty;
  for (int i = 0; i < kSamples; ++i) {
    const std::uint64_t begin = now();
    empty.push_back(now() - begin);
  }
  std::sort(empty.begin(), empty.end());
  double sum = 0;
  for (int i = 0; i < kKept; ++i) sum += static_cast<double>(empty[static_cast<std::size_t>(i)]);
  overhead_ = sum / kKept;
  // A step that is no whole number of counts reads now one count more, now one less.
  constexpr std::uint64_t kLeastStep = 3;
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = 1; i < kKept; ++i) {
    const std::uint64_t step = empty[i] - empty[i - 1];
    if (step >= kLeastStep) least = std::min(least, step);
  }
  if (least != std::numeric_limits<std::uint64_t>::max()) step_ = least;
}

}  // namespace carpus::bench
