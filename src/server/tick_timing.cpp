// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/tick_timing.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <ctime>

namespace carpus::server {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// A float's exponent and the first four bits of its fraction, as one number.
constexpr std::uint32_t kFractionBitsDropped = 19;
constexpr std::uint32_t kLeastWork = std::bit_cast<std::uint32_t>(0x1p-4F) >> kFractionBitsDropped;

class MonotonicTime final : public TickTime {
 public:
  std::int64_t now_ns() noexcept override {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * kNsPerSecond + time.tv_nsec;
  }

  void sleep_until(std::int64_t due_ns) noexcept override {
    timespec due{};
    due.tv_sec = due_ns / kNsPerSecond;
    due.tv_nsec = due_ns % kNsPerSecond;
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
    }
  }
};

}  // namespace

TickTime& monotonic_time() noexcept {
  static MonotonicTime time;
  return time;
}

void TickClock::start() noexcept {
  window_began_ns_ = time_->now_ns();
  due_ns_ = window_began_ns_ + kPeriodNs;
}

void TickClock::wait() noexcept {
  time_->sleep_until(due_ns_);
  began_ns_ = time_->now_ns();
  const std::int64_t late_ns = began_ns_ - due_ns_;
  late_before_work_ = late_ns > kPeriodNs ? 1 : 0;
  if (late_ns > kGiveUpNs) {
    late_before_work_ += static_cast<std::uint64_t>(late_ns / kPeriodNs - 1);
    due_ns_ = began_ns_;
  }
  due_ns_ += kPeriodNs;
}

void TickClock::work_done(bool has_worked) noexcept {
  const std::int64_t now = time_->now_ns();
  if (!has_worked) {
    window_began_ns_ = now;
    count_ = 0;
    timing_.rate_hz = timing_.p50_us = timing_.p99_us = 0;
    return;
  }
  const double work_us = static_cast<double>(now - began_ns_) / 1000.0;
  timing_.worst_us = std::max(timing_.worst_us, work_us);
  timing_.late_ticks += late_before_work_;
  add_to_histogram(static_cast<float>(work_us));
  if (++timing_.ticks % 100 == 0) {
    timing_.whole_p50_us = histogram_quantile(0.5);
    timing_.whole_p99_us = histogram_quantile(0.99);
  }
  work_us_[count_++] = static_cast<float>(work_us);
  if (count_ == kWindow) close_window(now);
}

void TickClock::add_to_histogram(float work_us) noexcept {
  const std::uint32_t number =
      std::bit_cast<std::uint32_t>(std::max(work_us, 0x1p-4F)) >> kFractionBitsDropped;
  ++histogram_[std::min<std::size_t>(number - kLeastWork, kHistogramSize - 1)];
}

double TickClock::histogram_quantile(double share) const noexcept {
  const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(timing_.ticks));
  std::uint64_t seen = 0;
  std::uint32_t i = 0;
  while (i + 1 < kHistogramSize && (seen += histogram_[i]) <= wanted) ++i;
  constexpr std::uint32_t kMiddle = 1U << (kFractionBitsDropped - 1);
  return std::bit_cast<float>(((i + kLeastWork) << kFractionBitsDropped) + kMiddle);
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
