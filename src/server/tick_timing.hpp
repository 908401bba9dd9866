// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The metronome of the 1 kHz thread, and the truth about how well it keeps time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carpus::server {

/// Measured over the last second; worst and late since the start. Plain bytes.
struct TickTiming {
  double rate_hz = 0.0;          ///< ticks begun per second of wall clock
  double p50_us = 0.0;           ///< time that a tick's work took
  double p99_us = 0.0;           ///< time that a tick's work took
  double worst_us = 0.0;         ///< longest work since the start
  std::uint64_t late_ticks = 0;  ///< begun more than a tick after they were due
};

/// Sleeps from tick to tick on the monotonic clock, with absolute due times so that errors do not
/// add up. Neither allocates nor throws.
class TickClock {
 public:
  /// The first tick is due one period from now.
  void start() noexcept;
  /// Sleeps until the next tick is due; at once when it is late. After a long stop (the computer
  /// slept, another program had the processor) it begins anew instead of hurrying after.
  void wait() noexcept;
  /// Between wait() and this lies the tick's work.
  void work_done() noexcept;
  [[nodiscard]] const TickTiming& timing() const noexcept { return timing_; }

  static constexpr std::int64_t kPeriodNs = 1'000'000;
  /// Later than this, ticks are given up rather than made up for.
  static constexpr std::int64_t kGiveUpNs = 100'000'000;
  static constexpr std::size_t kWindow = 1000;

 private:
  void close_window(std::int64_t now_ns) noexcept;

  std::int64_t due_ns_ = 0;
  std::int64_t began_ns_ = 0;
  std::int64_t window_began_ns_ = 0;
  std::size_t count_ = 0;
  std::array<float, kWindow> work_us_{};
  TickTiming timing_;
};

}  // namespace carpus::server
