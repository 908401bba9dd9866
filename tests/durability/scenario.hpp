// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a station does to the disk, in a process that may end at any moment, and the judge of what
// is found afterwards.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

namespace carpus::durability {

/// Exercises that one process does: all but the last end and are stored.
inline constexpr int kExercises = 3;
/// Ticks of those that end.
inline constexpr std::uint64_t kFinishedTicks = 1200;

/// Where the process has come; survives it.
struct Progress {
  struct OfExercise {
    std::array<char, 33> origin{};
    std::atomic<std::uint64_t> ticks{0};
    std::atomic<bool> is_over{false};    ///< it was finished and given to the records
    std::atomic<bool> is_stored{false};  ///< the records said so
  };
  std::array<OfExercise, kExercises> exercises;
  std::atomic<int> begun{0};
};

/// Memory that a child process shares.
class SharedProgress {
 public:
  SharedProgress();
  ~SharedProgress();
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  Progress* operator->() const { return progress_; }
  Progress& operator*() const { return *progress_; }
  /// As it is now, in memory of its own.
  void copy_from(const SharedProgress& other) const;

 private:
  Progress* progress_;
};

/// Makes what all processes share: the wrist and worlds that have not begun.
void prepare();

/// Operates as a station does: exercise after exercise as fast as the disk lets it, each with its
/// journal, stored when it is over. The last runs until it has `last_ticks`.
/// @return  how many attempts are not in the records at the end.
std::size_t operate(const std::filesystem::path& folder,
                    Progress& progress,
                    std::uint64_t last_ticks);

/// What a new station finds.
struct Found {
  std::string fault;             ///< the first promise that was not kept, or empty
  std::uint64_t lost_ticks = 0;  ///< of the exercise that ran
  bool went_on = false;
};

/// Starts anew on what is there: nothing that was over is lost, at most 1000 ticks of what ran, no
/// attempt twice or half.
[[nodiscard]] Found start_anew(const std::filesystem::path& folder, const Progress& before);

}  // namespace carpus::durability
