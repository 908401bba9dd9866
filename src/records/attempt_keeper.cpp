// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/attempt_keeper.hpp"

#include <array>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace carpus::records {

namespace {

namespace fs = std::filesystem;

/// A name that says when the attempt was made: "attempts.rescued-20260131T120000000Z.sqlite".
fs::path rescue_name(const fs::path& records, const Attempt& attempt) {
  std::string stamp;
  for (const char c : attempt.summary.ended_at) {
    if ((c >= '0' && c <= '9') || c == 'T' || c == 'Z') stamp += c;
  }
  return records.stem().string() + ".rescued-" + stamp + ".sqlite";
}

/// Writes one attempt to a records file of its own; empty where that is impossible too.
fs::path rescue(const fs::path& records, const Attempt& attempt) {
  std::error_code ignored;
  const fs::path name = rescue_name(records, attempt);
  for (const fs::path& folder : {records.parent_path(), fs::temp_directory_path(ignored)}) {
    const fs::path file = folder / name;
    const bool existed = fs::exists(file, ignored);
    try {
      AttemptStore(file).save(attempt);
      return file;
    } catch (const Error&) {
      if (existed) continue;
      for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
        fs::remove(file.string() + suffix, ignored);
      }
    }
  }
  return {};
}

}  // namespace

KeptAttempt AttemptKeeper::save(const Attempt& attempt) {
  const std::lock_guard lock(mutex_);
  try {
    const std::int64_t id = store_.save(attempt);
    retry_waiting();
    return {id, {}};
  } catch (const Error& error) {
    fs::path file = rescue(store_.file(), attempt);
    KeptAttempt kept{0, error.what()};
    kept.problem += file.empty()
                        ? ". The attempt is kept in memory and stored with the next one that "
                          "succeeds; do not stop the program before"
                        : ". The attempt was saved to " + file.string() +
                              " instead, which 'carpus attempts --records' reads";
    waiting_.push_back({attempt, std::move(file)});
    return kept;
  }
}

void AttemptKeeper::retry_waiting() {
  while (!waiting_.empty()) {
    try {
      store_.save(waiting_.front().attempt);
    } catch (const Error&) {
      return;
    }
    std::error_code ignored;
    if (!waiting_.front().rescue_file.empty()) fs::remove(waiting_.front().rescue_file, ignored);
    waiting_.erase(waiting_.begin());
  }
}

std::vector<AttemptSummary> AttemptKeeper::list() const {
  const std::lock_guard lock(mutex_);
  return store_.list();
}

std::optional<Attempt> AttemptKeeper::find(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  return store_.find(id);
}

std::size_t AttemptKeeper::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size();
}

}  // namespace carpus::records
