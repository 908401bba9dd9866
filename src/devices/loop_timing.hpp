// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How well a loop keeps time: how late each turn began, and what it missed, by a histogram of fixed
// size. Figures are to 3 %.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace carpus::devices {

/// Times in microseconds by octaves of thirty-two parts each, from 2^-4 us to 2^22.
class TimeHistogram {
 public:
  void add(double us) noexcept;
  /// The time that `share` of all do not exceed; 0 where there are none.
  [[nodiscard]] double quantile(double share) const noexcept;
  [[nodiscard]] double most() const noexcept { return most_; }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  void clear() noexcept { *this = {}; }

 private:
  static constexpr std::size_t kParts = 32;
  static constexpr std::size_t kSize = 26 * kParts;

  std::array<std::uint32_t, kSize> parts_{};
  std::uint64_t count_ = 0;
  double most_ = 0;
};

/// Which class the kernel gave the loop's thread.
enum class SchedulingClass : std::uint8_t { Other = 0, Fifo = 1 };

/// Plain bytes, for the page and `carpus device test`.
struct LoopTiming {
  SchedulingClass scheduling = SchedulingClass::Other;
  bool memory_locked = false;
  bool fine_timer = false;  ///< the kernel took the timer's slack away
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;  ///< due times that had passed before their turn began
  double rate_hz = 0;        ///< over the last second
  // How late a turn began, and how long a question to the device took, of the last whole second:
  double late_p50_us = 0;
  double late_p99_us = 0;
  double late_p999_us = 0;
  double late_worst_us = 0;
  double round_trip_p50_us = 0;
  double round_trip_p99_us = 0;
  double work_share = 0;  ///< of a period that the turns' work took
};

}  // namespace carpus::devices
