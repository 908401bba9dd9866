// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Attempts, how they were rated and answers of the view quiz in one SQLite file. One connection,
// for one thread at a time; several processes may share the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "records/asset_form.hpp"
#include "records/attempt.hpp"
#include "records/quiz_answer.hpp"

namespace carpus::records {

/// Schema of the records file that this program writes; it reads and updates older ones.
inline constexpr int kRecordsSchemaVersion = 6;

/// Another program holds the file; later it may not.
class RecordsBusy : public IoError {
 public:
  using IoError::IoError;
};

/// Attempts as a list shows them, newest first.
struct AttemptPage {
  std::vector<AttemptSummary> attempts;
  bool older = false;      ///< there are older ones than the last of these
  std::int64_t total = 0;  ///< attempts in the records
};

/// Whether an attempt, or an answer, is for whoever asks, by its number.
using AttemptFilter = std::function<bool(std::int64_t id)>;

class AttemptStore {
 public:
  /// So long a file is looked through for damage when it is opened; 'carpus attempts --check' looks
  /// through all of it.
  static constexpr std::chrono::milliseconds kCheckTime{1000};

  /// Opens the file, creating it where there is none and updating an older one.
  /// @param patience  how long a call waits for another program that is writing.
  /// @throws IoError  it cannot be opened, created or written, is damaged, or is no records file;
  /// @throws SchemaError  it was written by a newer version of the program.
  explicit AttemptStore(const std::filesystem::path& file,
                        std::chrono::milliseconds patience = std::chrono::milliseconds(5000));
  ~AttemptStore();
  AttemptStore(AttemptStore&&) noexcept;
  AttemptStore& operator=(AttemptStore&&) noexcept;

  /// Stores an attempt as a whole and returns its number; of one that is there already, by its
  /// origin, the number that it has.
  /// @throws IoError  nothing of it was stored; the message says what to do.
  std::int64_t save(const Attempt& attempt);

  /// Stores an answer of the view quiz and returns its number. @throws as for an attempt.
  std::int64_t save(const QuizAnswer& answer);

  /// Stores how somebody rated an attempt, or amends it. @param amended  the revision of the form
  /// that they saw, 0 of none: what another saved meanwhile is not overwritten. @throws as for an
  /// attempt.
  [[nodiscard]] AssetSaving save(const AssetForm& form, std::int64_t amended);

  /// Forms of one attempt, the oldest first, unfinished ones too.
  [[nodiscard]] std::vector<AssetForm> asset_forms(std::int64_t attempt) const;

  /// Answers of the view quiz, as `page` for attempts.
  [[nodiscard]] QuizAnswerPage quiz_page(std::int64_t before,
                                         std::size_t most,
                                         const AttemptFilter& seen = {}) const;

  /// Newest first.
  [[nodiscard]] std::vector<AttemptSummary> list() const;

  /// At most so many, with numbers below `before`; 0 begins with the newest. @param seen  those
  /// that are for whoever asks; all without it.
  [[nodiscard]] AttemptPage page(std::int64_t before,
                                 std::size_t most,
                                 const AttemptFilter& seen = {}) const;

  /// Whether an attempt of this origin is stored.
  [[nodiscard]] bool holds(const std::string& origin) const;

  /// The attempt with this number, or nothing.
  [[nodiscard]] std::optional<Attempt> find(std::int64_t id) const;

  /// Lets the file grow to at most so many pages of 4 KiB: a full disk for tests.
  void limit_pages(int pages);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  struct Connection;
  [[nodiscard]] std::optional<std::int64_t> id_of(const std::string& origin) const;

  std::filesystem::path file_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace carpus::records
