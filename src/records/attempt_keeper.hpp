// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Saving that loses nothing and that nobody waits for: a thread of its own stores attempts, tries
// again, and takes back what it had to put elsewhere. All but construction may be called from any
// thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "records/attempt.hpp"
#include "records/attempt_store.hpp"

namespace carpus::records {

/// What became of an attempt.
struct KeptAttempt {
  std::int64_t id = 0;      ///< its number in the records; 0 when it could not be stored there
  std::string problem;      ///< empty, or what went wrong, where the attempt is now and what to do
  bool is_on_disk = false;  ///< in the records or in a file beside them
};

struct KeeperPatience {
  /// For a file that another program holds, before the attempt goes to a rescue file.
  std::chrono::milliseconds busy{5000};
  /// Between tries to store what waits.
  std::chrono::milliseconds retry{10'000};
};

class AttemptKeeper {
 public:
  using Done = std::function<void(const KeptAttempt&)>;
  /// One line for the person who runs the station; called in the keeper's thread.
  using Say = std::function<void(const std::string&)>;

  /// More wait nowhere: a further attempt is refused with a word.
  static constexpr std::size_t kMostWaiting = 64;
  /// A list or an attempt is not worth more waiting than this while another program writes.
  static constexpr std::chrono::milliseconds kReadPatience{50};

  /// Takes back what was rescued before, by and by.
  /// @throws as AttemptStore: a station must not start without a place for its records.
  explicit AttemptKeeper(const std::filesystem::path& file,
                         Say say = {},
                         KeeperPatience patience = {});
  /// As `settle`.
  ~AttemptKeeper();
  AttemptKeeper(const AttemptKeeper&) = delete;
  AttemptKeeper& operator=(const AttemptKeeper&) = delete;

  /// Never waits, never throws for a disk that fails. @param done  called once in the keeper's
  /// thread, or at once where too many wait.
  void save(Attempt attempt, Done done);
  /// The same, waited for: for a command that has nothing else to do.
  KeptAttempt save(const Attempt& attempt);
  /// An answer of the view quiz. What the records refuse waits in memory and goes with the program:
  /// an answer is not worth a file of its own.
  void save(QuizAnswer answer, Done done);

  /// Stores or amends an ASSET form, waited for: who filled it in has it still, so what the records
  /// refuse does not wait. @throws IoError
  [[nodiscard]] AssetSaving save(const AssetForm& form, std::int64_t amended);

  /// Waits until all that came was tried, tries what waits once more, and returns how many still
  /// do.
  std::size_t settle();

  /// How many attempts and answers are not in the records yet: in memory or in rescue files.
  [[nodiscard]] std::size_t waiting() const;

  /// What is in the records; those that wait are not. @throws IoError
  [[nodiscard]] std::vector<AttemptSummary> list() const;
  [[nodiscard]] AttemptPage page(std::int64_t before,
                                 std::size_t most,
                                 const AttemptFilter& seen = {}) const;
  [[nodiscard]] std::optional<Attempt> find(std::int64_t id) const;
  [[nodiscard]] QuizAnswerPage quiz_page(std::int64_t before,
                                         std::size_t most,
                                         const AttemptFilter& seen = {}) const;
  [[nodiscard]] std::vector<AssetForm> asset_forms(std::int64_t attempt) const;
  [[nodiscard]] bool holds(const std::string& origin) const;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return writing_.file(); }
  /// For tests that need a full disk.
  AttemptStore& store() noexcept { return writing_; }

 private:
  using Job = std::function<void()>;
  void run();
  /// @return whether there is room for it.
  [[nodiscard]] bool queue(Job job);
  [[nodiscard]] KeptAttempt keep(Attempt attempt);
  [[nodiscard]] KeptAttempt keep(QuizAnswer answer);
  void try_what_waits();
  void take_back_rescued();
  void say(const std::string& line) const;

  AttemptStore writing_;  ///< the thread's
  mutable std::mutex reading_mutex_;
  AttemptStore reading_;  ///< everybody else's
  Say say_;
  KeeperPatience patience_;
  std::vector<Attempt> in_memory_;  ///< the thread's: not even a rescue file could be written
  std::vector<QuizAnswer> answers_in_memory_;  ///< the thread's too

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> queue_;
  std::uint64_t asked_to_settle_ = 0;
  std::uint64_t settled_ = 0;
  std::size_t waiting_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace carpus::records
