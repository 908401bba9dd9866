// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From which browser an attempt was made, as long as the station runs: a trainee sees those that
// were made from their own, and nobody else's.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

#include "server/access_links.hpp"

namespace carpus::server {

/// May be used from several threads.
class AttemptOwners {
 public:
  /// More are forgotten, the oldest first.
  static constexpr std::size_t kMaxAttempts = 10'000;

  void add(std::int64_t attempt, const std::string& browser) {
    if (browser.empty()) return;
    const std::lock_guard lock(mutex_);
    if (!browsers_.insert_or_assign(attempt, browser).second) return;
    order_.push_back(attempt);
    if (order_.size() <= kMaxAttempts) return;
    browsers_.erase(order_.front());
    order_.pop_front();
  }

  /// Never of a browser that has no word.
  [[nodiscard]] bool is_of(std::int64_t attempt, std::string_view browser) const {
    if (browser.empty()) return false;
    const std::lock_guard lock(mutex_);
    const auto found = browsers_.find(attempt);
    return found != browsers_.end() && same_secret(found->second, browser);
  }

 private:
  mutable std::mutex mutex_;
  std::unordered_map<std::int64_t, std::string> browsers_;
  std::deque<std::int64_t> order_;
};

}  // namespace carpus::server
