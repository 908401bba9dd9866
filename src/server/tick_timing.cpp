// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/tick_timing.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace carpus::server {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t now_ns() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kNsPerSecond + time.tv_nsec;
}

void sleep_until(std::int64_t due_ns) noexcept {
  timespec due{};
  due.tv_sec = due_ns / kNsPerSecond;
  due.tv_nsec = due_ns % kNsPerSecond;
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

}  // namespace

void TickClock::start() noexcept {
  window_began_ns_ = now_ns();
  due_ns_ = window_began_ns_ + kPeriodNs;
}

void TickClock::wait() noexcept {
  sleep_until(due_ns_);
  began_ns_ = now_ns();
  const std::int64_t late_ns = began_ns_ - due_ns_;
  if (late_ns > kPeriodNs) ++timing_.late_ticks;
  if (late_ns > kGiveUpNs) {
    timing_.late_ticks += static_cast<std::uint64_t>(late_ns / kPeriodNs - 1);
    due_ns_ = began_ns_;
  }
  due_ns_ += kPeriodNs;
}

void TickClock::work_done() noexcept {
  const std::int64_t now = now_ns();
  const double work_us = static_cast<double>(now - began_ns_) / 1000.0;
  timing_.worst_us = std::max(timing_.worst_us, work_us);
  work_us_[count_++] = static_cast<float>(work_us);
  if (count_ == kWindow) close_window(now);
}

void TickClock::close_window(std::int64_t now) noexcept {
  const auto p50 = work_us_.begin() + kWindow / 2;
  const auto p99 = work_us_.begin() + kWindow * 99 / 100;
  std::nth_element(work_us_.begin(), p99, work_us_.end());
  timing_.p99_us = static_cast<double>(*p99);
  std::nth_element(work_us_.begin(), p50, p99);
  timing_.p50_us = static_cast<double>(*p50);
  timing_.rate_hz = static_cast<double>(kWindow) * static_cast<double>(kNsPerSecond) /
                    static_cast<double>(now - window_began_ns_);
  window_began_ns_ = now;
  count_ = 0;
}

}  // namespace carpus::server
