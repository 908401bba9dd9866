// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A running exercise on disk: its head, then inputs, log and keyframes as they come, so that it can
// be gone on with after the program was killed. Used in one thread, the network's; the disk is
// another's (records/journal_writer.hpp).
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "protocol/bodies.hpp"
#include "records/journal_block.hpp"
#include "records/journal_writer.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {

class ExerciseJournal {
 public:
  /// What was done is handed to the disk this often [ticks], and after this time where fewer pass.
  static constexpr Tick kPartTicks = 250;
  static constexpr std::chrono::milliseconds kPartTime{250};

  /// Of an exercise that begins. Never waits for the disk nor fails: `progress` tells.
  /// @param recording  of no ticks yet.
  ExerciseJournal(const std::filesystem::path& file,
                  const protocol::RunningExercise& head,
                  const simulation::Recording& recording);
  /// Goes on with one that was found. @param tick  how far it goes. @param last  input of that
  /// tick.
  ExerciseJournal(records::JournalPlace place, Tick tick, const simulation::Input& last);

  /// A tick's input, as the recorder gets it.
  void append(const simulation::Input& input);
  /// Lines of the log, of ticks up to the last that was appended or soon is.
  void append(const std::vector<protocol::LoggedEvent>& events);
  /// Of the state after the last input.
  void append(const simulation::Keyframe& keyframe, std::uint64_t state_hash);
  /// Which page operates, by its word in hello.
  void note_owner(const std::string& word);
  /// Hands what came since to the disk when it is time. @param state_hash  after the last input.
  void hand_over(std::uint64_t state_hash);
  /// The same, at once.
  void hand_over_now(std::uint64_t state_hash);

  /// Marks are ticks.
  [[nodiscard]] records::JournalProgress progress() const { return writer_.progress(); }
  [[nodiscard]] Tick tick() const noexcept { return tick_; }
  [[nodiscard]] const std::string& owner() const noexcept { return owner_; }
  bool wait_until_safe(std::chrono::milliseconds time) const {
    return writer_.wait_until_safe(time);
  }
  /// The attempt is stored elsewhere: deletes the file. From any thread.
  void remove() { writer_.remove(); }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return writer_.file(); }

 private:
  records::JournalWriter writer_;
  simulation::RunEncoder encoder_;
  simulation::InputRun run_;  ///< not encoded yet
  std::vector<protocol::LoggedEvent> events_;
  std::string owner_;
  Tick tick_ = 0;
  Tick handed_over_ = 0;
  std::chrono::steady_clock::time_point handed_over_at_ = std::chrono::steady_clock::now();
};

/// What a journal holds.
struct JournaledExercise {
  protocol::RunningExercise head;
  simulation::Recording recording;  ///< with its keyframes; its end is the journal's
  std::vector<protocol::LoggedEvent> log;
  std::string owner;
};

/// Whose it is, where that can be read.
[[nodiscard]] Result<protocol::RunningExercise> read_head(const records::JournalContent& journal);

/// Untrusted; refuses by name.
[[nodiscard]] Result<JournaledExercise> read_exercise(const records::JournalContent& journal);

}  // namespace carpus::server
