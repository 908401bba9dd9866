// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One exercise as the station hosts it: a world in its 1 kHz thread, the recording, the log, the
// journal that keeps them on disk as they come, and the attempt that is kept of it at the end. Used
// in one thread, the network's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "records/attempt.hpp"
#include "server/exercise_journal.hpp"
#include "server/simulation_loop.hpp"
#include "session/session.hpp"
#include "simulation/recording.hpp"
#include "simulation/world.hpp"

namespace carpus::server {

struct ExerciseSetup {
  std::string trainee;
  std::string input_device;
  const procedure::Procedure* procedure = nullptr;  ///< must outlive the exercise
  std::uint64_t seed = 0;
  procedure::Mode mode = procedure::Mode::Practice;
  std::optional<cases::PreparedPathology> prepared{};  ///< to be wrong in an examined wrist
  std::uint64_t number = 0;                            ///< the station's count
  TickGuest* guest = nullptr;  ///< devices that hold a hand; must outlive the exercise
};

/// Where an exercise stands when its thread starts: at its beginning, or where a journal ends.
struct ExerciseStart {
  std::string origin;      ///< no two attempts have the same
  std::string started_at;  ///< UTC, ISO 8601
  simulation::World world;
  /// Steps behind the live world, from the recorded inputs: keyframes are written from it, which
  /// the 1 kHz thread has no time for, and its hash says whether the recording is true.
  simulation::World shadow;
  simulation::Recorder recorder;
  std::vector<protocol::LoggedEvent> log;
  std::unique_ptr<ExerciseJournal> journal;  ///< none: it is in memory only
  bool paused = false;
};

/// A new one. @param records  beside which its journal lies; empty: it has none.
/// @throws InvalidInput when the case cannot be operated on.
[[nodiscard]] ExerciseStart begin_anew(const cases::CaseData& data,
                                       std::uint64_t case_fingerprint,
                                       const ExerciseSetup& setup,
                                       const std::filesystem::path& records);
/// The same with worlds that were made before: that takes longer than all else.
[[nodiscard]] ExerciseStart begin_anew(const cases::CaseData& data,
                                       std::uint64_t case_fingerprint,
                                       const ExerciseSetup& setup,
                                       const std::filesystem::path& records,
                                       simulation::World world,
                                       simulation::World shadow);

/// How a picture came about; the numbers of protocol/README.md.
enum class PictureKind : std::uint32_t { Shot = 0, Live = 1, Held = 2, Quiz = 3 };

/// A picture that was taken: where the C-arm stood in the room, and the state at that tick.
struct TakenShot {
  PictureKind kind = PictureKind::Shot;
  std::uint32_t number = 0;          ///< 0 while live
  std::uint64_t exercise = 0;        ///< the station's count, to tell late pictures from new ones
  BoneId target = BoneId::Scaphoid;  ///< what the beam is centred on
  double rotation_deg = 0.0;         ///< from the forearm as scanned
  double tilt_deg = 0.0;
  simulation::Snapshot snapshot;
};

/// The pictures that a tick's state leaves for good: shots, and what a live picture ends with.
[[nodiscard]] std::vector<TakenShot> pictures_of(const procedure::Procedure& procedure,
                                                 const EventfulTick& tick);

/// What happened since the last look.
struct ExerciseNews {
  std::vector<protocol::LoggedEvent> events;  ///< for the records
  std::vector<protocol::LoggedEvent> told;    ///< for the page
  std::vector<TakenShot> shots;
};

class Exercise {
 public:
  /// Starts at once. @param data  as scanned; must outlive it.
  Exercise(const cases::CaseData& data, ExerciseSetup setup, ExerciseStart start);

  /// The loop's controls: hold, command, pause.
  [[nodiscard]] SimulationLoop& loop() noexcept { return loop_; }
  /// What page and exercise say to each other.
  [[nodiscard]] session::Session& session() noexcept { return session_; }

  /// Takes over what was done since; to be called many times a second.
  [[nodiscard]] ExerciseNews collect();

  /// True when there is a newer state than at the last call; `state()` has it.
  bool update() noexcept { return loop_.take_state(state_); }
  /// The live picture of that state, once for each pulse of the tube; none while the pedal is up.
  [[nodiscard]] std::optional<TakenShot> live_picture();
  [[nodiscard]] const LoopState& state() const noexcept { return state_; }

  /// Whose it is, as typed, and since when [UTC, ISO 8601].
  [[nodiscard]] const std::string& trainee() const noexcept { return setup_.trainee; }
  [[nodiscard]] const std::string& started_at() const noexcept { return started_at_; }
  /// All that was collected so far.
  [[nodiscard]] const std::vector<protocol::LoggedEvent>& log() const noexcept { return log_; }

  /// What is done from now on is this page's.
  void note_owner(const std::string& word);
  /// How far the disk has come; nothing where there is no journal.
  [[nodiscard]] std::optional<records::JournalProgress> on_disk() const;
  /// How far it has been collected.
  [[nodiscard]] Tick collected() const noexcept { return recorder_.tick(); }
  /// After the end: to be removed once the attempt is stored.
  [[nodiscard]] std::unique_ptr<ExerciseJournal> take_journal() { return std::move(journal_); }

  /// Stops the thread and returns what is to be kept: with a score when the operation was
  /// finished. The last news are in the attempt's log. Call once.
  [[nodiscard]] records::Attempt end();

 private:
  void add_news(const EventfulTick& tick, ExerciseNews& news) const;

  ExerciseSetup setup_;
  const cases::CaseData& data_;
  std::string origin_;
  std::string started_at_;
  simulation::World world_;
  simulation::World shadow_;
  session::Session session_;
  simulation::Recorder recorder_;
  std::vector<protocol::LoggedEvent> log_;
  std::unique_ptr<ExerciseJournal> journal_;
  LoopState state_;
  std::uint32_t pulses_shown_ = 0;
  SimulationLoop loop_;  ///< last, so that its thread ends before what it uses
};

/// The record of one attempt, however it was made: a station's exercise or a scripted trainee's.
struct AttemptParts {
  const cases::CaseData& data;
  const simulation::Recording& recording;
  const std::vector<protocol::LoggedEvent>& log;
  std::optional<procedure::ScoreReport> score;  ///< of a finished operation
  std::string trainee;
  std::string input_device;
  std::string started_at;
  std::string origin = {};  ///< empty: it is of no journal
};
[[nodiscard]] records::Attempt make_attempt(const AttemptParts& parts);

}  // namespace carpus::server
