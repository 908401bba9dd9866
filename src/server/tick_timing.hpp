// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The metronome of the 1 kHz thread, and the truth about how well it keeps time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carpus::server {

/// Of ticks in which something was simulated; pauses do not count. Plain bytes.
struct TickTiming {
  // Over the last 1000 ticks:
  double rate_hz = 0.0;  ///< ticks per second of wall clock
  double p50_us = 0.0;   ///< time that a tick's work took
  double p99_us = 0.0;
  // Since the start:
  double whole_p50_us = 0.0;  ///< to 3 %, of every hundredth tick on
  double whole_p99_us = 0.0;
  double worst_us = 0.0;
  std::uint64_t ticks = 0;
  std::uint64_t late_ticks = 0;  ///< begun more than a tick after they were due
};

/// What a metronome goes by; tests let it pass by hand.
class TickTime {
 public:
  virtual ~TickTime() = default;
  [[nodiscard]] virtual std::int64_t now_ns() noexcept = 0;
  /// At once when it is past. May return late, never early.
  virtual void sleep_until(std::int64_t due_ns) noexcept = 0;
};

/// The system's monotonic clock; has no state of its own.
[[nodiscard]] TickTime& monotonic_time() noexcept;

/// Sleeps from tick to tick, with absolute due times so that errors do not
/// add up. Neither allocates nor throws.
class TickClock {
 public:
  /// @param time  must outlive this.
  explicit TickClock(TickTime& time = monotonic_time()) noexcept : time_(&time) {}
  /// The first tick is due one period from now.
  void start() noexcept;
  /// Sleeps until the next tick is due; at once when it is late. After a long stop (the computer
  /// slept, another program had the processor) it begins anew instead of hurrying after.
  void wait() noexcept;
  /// Between wait() and this lies the tick's work; `has_worked` false: a pause, in which time is
  /// not measured.
  void work_done(bool has_worked) noexcept;
  [[nodiscard]] const TickTiming& timing() const noexcept { return timing_; }

  static constexpr std::int64_t kPeriodNs = 1'000'000;
  /// Later than this, ticks are given up rather than made up for.
  static constexpr std::int64_t kGiveUpNs = 100'000'000;
  static constexpr std::size_t kWindow = 1000;

 private:
  /// Work in microseconds by octaves of sixteen parts each, from 2^-4 us.
  static constexpr std::size_t kHistogramParts = 16;
  static constexpr std::size_t kHistogramSize = 26 * kHistogramParts;

  void close_window(std::int64_t now_ns) noexcept;
  void add_to_histogram(float work_us) noexcept;
  [[nodiscard]] double histogram_quantile(double share) const noexcept;

  TickTime* time_;
  std::int64_t due_ns_ = 0;
  std::int64_t began_ns_ = 0;
  std::int64_t window_began_ns_ = 0;
  std::size_t count_ = 0;
  std::uint64_t late_before_work_ = 0;
  std::array<float, kWindow> work_us_{};
  std::array<std::uint32_t, kHistogramSize> histogram_{};
  TickTiming timing_;
};

}  // namespace carpus::server
