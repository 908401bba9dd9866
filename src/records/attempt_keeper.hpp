// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Saving that loses nothing. Called from one thread, but for list and find, which may be called
// from any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "records/attempt.hpp"
#include "records/attempt_store.hpp"

namespace carpus::records {

/// What became of an attempt.
struct KeptAttempt {
  std::int64_t id = 0;  ///< its number in the records; 0 when it could not be stored there
  std::string problem;  ///< empty, or what went wrong, where the attempt is now and what to do
};

/// Stores attempts; what cannot be stored goes to a records file of its own beside the first (or
/// in the folder for temporary files), and stays in memory until a later save succeeds.
class AttemptKeeper {
 public:
  /// @throws as AttemptStore: a station must not start without a place for its records.
  explicit AttemptKeeper(const std::filesystem::path& file) : store_(file) {}

  /// Never throws for a disk that fails: it says so in the answer.
  KeptAttempt save(const Attempt& attempt);

  /// Newest first; those that wait in memory are not among them.
  [[nodiscard]] std::vector<AttemptSummary> list() const;
  [[nodiscard]] std::optional<Attempt> find(std::int64_t id) const;

  /// How many wait in memory for a disk that accepts them.
  [[nodiscard]] std::size_t waiting() const;

  /// For tests that need a full disk.
  AttemptStore& store() noexcept { return store_; }

 private:
  struct Waiting {
    Attempt attempt;
    std::filesystem::path rescue_file;  ///< empty when not even that could be written
  };
  void retry_waiting();

  mutable std::mutex mutex_;  ///< one connection is for one thread at a time
  AttemptStore store_;
  std::vector<Waiting> waiting_;
};

}  // namespace carpus::records
