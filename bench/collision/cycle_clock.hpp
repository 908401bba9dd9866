// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Times single queries of tens of nanoseconds: the processor's own counter, fenced, with the cost
// of reading it measured and subtracted. Wall time: what interrupts a query counts.
#pragma once

#include <cstdint>
#include <ctime>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace carpus::bench {

class CycleClock {
 public:
  /// Calibrates against the system's clock, about 20 ms.
  CycleClock();

  [[nodiscard]] static std::uint64_t now() noexcept {
#if defined(__x86_64__)
    _mm_lfence();
    const std::uint64_t t = __rdtsc();
    _mm_lfence();
    return t;
#else
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<std::uint64_t>(t.tv_sec) * 1'000'000'000U +
           static_cast<std::uint64_t>(t.tv_nsec);
#endif
  }
  /// Between two now(), less what an empty measurement takes in the mean: of short times it is the
  /// mean that is right, and one reading may be below zero.
  [[nodiscard]] double seconds(std::uint64_t begin, std::uint64_t end) const noexcept {
    return (static_cast<double>(end - begin) - overhead_) * seconds_per_count_;
  }
  [[nodiscard]] double overhead_seconds() const noexcept { return overhead_ * seconds_per_count_; }

  /// The counter's step.
  [[nodiscard]] double resolution_seconds() const noexcept {
    return static_cast<double>(step_) * seconds_per_count_;
  }

 private:
  std::uint64_t step_ = 1;
  double overhead_ = 0;
  double seconds_per_count_ = 0;
};

}  // namespace carpus::bench
