// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How many messages a page may send: a bucket that refills.
#pragma once

#include <algorithm>
#include <chrono>

namespace carpus::server {

/// Lets `per_second` messages pass in the long run and `burst` at once.
class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;

  RateLimit(double per_second, double burst) noexcept
      : per_second_(per_second), burst_(burst), tokens_(burst) {}

  /// Whether one more may pass now.
  [[nodiscard]] bool allows(Clock::time_point now) noexcept {
    const double seconds = std::chrono::duration<double>(now - last_).count();
    tokens_ = std::min(burst_, tokens_ + std::max(0.0, seconds) * per_second_);
    last_ = now;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double per_second_;
  double burst_;
  double tokens_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace carpus::server
