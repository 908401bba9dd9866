// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Attempts in one SQLite file. One connection, for one thread at a time; several processes may
// share the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "records/attempt.hpp"

namespace carpus::records {

/// Schema of the records file that this program writes; it reads and updates older ones.
inline constexpr int kRecordsSchemaVersion = 2;

class AttemptStore {
 public:
  /// Opens the file, creating it where there is none and updating an older one.
  /// @throws IoError  it cannot be opened, created or written, or is no records file;
  /// @throws SchemaError  it was written by a newer version of the program.
  explicit AttemptStore(const std::filesystem::path& file);
  ~AttemptStore();
  AttemptStore(AttemptStore&&) noexcept;
  AttemptStore& operator=(AttemptStore&&) noexcept;

  /// Stores an attempt as a whole and returns its number.
  /// @throws IoError  nothing of it was stored; the message says what to do.
  std::int64_t save(const Attempt& attempt);

  /// Newest first.
  [[nodiscard]] std::vector<AttemptSummary> list() const;

  /// The attempt with this number, or nothing.
  [[nodiscard]] std::optional<Attempt> find(std::int64_t id) const;

  /// Lets the file grow to at most so many pages of 4 KiB: a full disk for tests.
  void limit_pages(int pages);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  struct Connection;
  std::filesystem::path file_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace carpus::records
