// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/precise_clock.hpp"

#include <cerrno>
#include <ctime>

namespace carpus::devices {
namespace {

constexpr Nanoseconds kNsPerSecond = 1'000'000'000;

void sleep_until(Nanoseconds due_ns) noexcept {
  timespec due{};
  due.tv_sec = due_ns / kNsPerSecond;
  due.tv_nsec = due_ns % kNsPerSecond;
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

}  // namespace

Nanoseconds monotonic_now() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kNsPerSecond + time.tv_nsec;
}

Nanoseconds PreciseClock::wait(std::uint64_t& missed) noexcept {
  sleep_until(due_ns_ - kSpinNs);
  Nanoseconds now = monotonic_now();
  while (now < due_ns_) now = monotonic_now();
  const Nanoseconds late = now - due_ns_;
  // A turn that begins after the next was due has missed that one: a device is not told twice.
  const Nanoseconds passed = late / kPeriodNs;
  missed += static_cast<std::uint64_t>(passed);
  due_ns_ += (passed + 1) * kPeriodNs;
  return late;
}

}  // namespace carpus::devices
