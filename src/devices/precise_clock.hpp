// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The metronome of a device's loop: absolute due times on the monotonic clock, sleep until shortly
// before, then spin. A sleep alone wakes 30 to 80 us late, and a spin alone is throttled by the
// kernel when it runs in the real-time class: some of every period is slept.
#pragma once

#include <cstdint>

#include "devices/device.hpp"

namespace carpus::devices {

[[nodiscard]] Nanoseconds monotonic_now() noexcept;

class PreciseClock {
 public:
  static constexpr Nanoseconds kPeriodNs = kNsPerMs;
  /// Longer than the kernel takes to wake a thread in 95 of 100 cases.
  static constexpr Nanoseconds kSpinNs = 140'000;

  /// The first turn is due one period from now.
  void start() noexcept { due_ns_ = monotonic_now() + kPeriodNs; }
  /// @return how late the turn begins [ns]. @param missed  is raised by the due times that passed
  /// before this turn began.
  [[nodiscard]] Nanoseconds wait(std::uint64_t& missed) noexcept;

 private:
  Nanoseconds due_ns_ = 0;
};

}  // namespace carpus::devices
