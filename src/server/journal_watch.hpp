// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Keeps the promise that a power cut takes at most the last second: where the disk falls behind,
// time stands still; where it takes nothing, the operation goes on and that is said.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/units.hpp"
#include "records/journal_writer.hpp"

namespace carpus::server {

class JournalWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Ticks that may be in memory alone, with those that are still to be collected, before time
  /// stands still.
  static constexpr Tick kMostBehind = 850;
  /// So long time stands still for a disk before the operation goes on without it.
  static constexpr std::chrono::milliseconds kMostWait{5000};

  struct Verdict {
    bool holds_time = false;
    std::string word;  ///< to be said once, empty for nothing new
  };

  /// @param collected  the last tick that was handed to the journal.
  [[nodiscard]] Verdict look(const std::optional<records::JournalProgress>& on_disk,
                             Tick collected,
                             Clock::time_point now);

 private:
  std::optional<Clock::time_point> behind_since_;
  std::string said_;
};

}  // namespace carpus::server
