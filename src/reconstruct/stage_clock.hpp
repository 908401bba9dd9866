// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How long each stage of a piece of work takes.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::reconstruct {

struct StageTime {
  std::string name;
  double seconds = 0;
  /// Of the whole program up to the stage's end, where it was asked for; 0 otherwise.
  double peak_memory_bytes = 0;
};

/// Begins a stage where the one before ends. A stage that comes back adds to its time.
class StageClock {
 public:
  using Clock = std::chrono::steady_clock;

  void begin(std::string_view name) {
    end();
    current_ = 0;
    while (current_ < stages_.size() && stages_[current_].name != name) ++current_;
    if (current_ == stages_.size()) stages_.push_back({std::string(name)});
    started_ = Clock::now();
    running_ = true;
  }
  void end() {
    if (running_) stages_[current_].seconds += seconds_since(started_);
    running_ = false;
  }
  [[nodiscard]] const std::vector<StageTime>& stages() const { return stages_; }

  [[nodiscard]] static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  std::vector<StageTime> stages_;
  std::size_t current_ = 0;
  Clock::time_point started_;
  bool running_ = false;
};

}  // namespace carpus::reconstruct
