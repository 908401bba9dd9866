// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An exercise that a script does as fast as it can, with the journal that a station would write.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "core/version.hpp"
#include "server/exercise.hpp"
#include "server/exercise_journal.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::server::testing {

/// A hand that never rests: circles over the wrist, looks now and then, ends with Finish.
[[nodiscard]] inline simulation::Input scripted_input(const simulation::Snapshot& now, Tick last) {
  simulation::Input input;
  input.wrist = now.wrist;
  const auto step = static_cast<double>(now.tick % 4000);
  const double away = step < 2000 ? step : 4000 - step;
  input.hands[0].tip_in_patient = {40.0 - 0.01 * away, 40.0, 40.0 + 0.005 * away};
  input.hands[0].shaft_in_patient = {0, 0.6, 0.8};
  input.hands[1].tip_in_patient = {0, 150, 0};
  input.hands[1].shaft_in_patient = {0, 1, 0};
  if (now.tick % 700 == 350) input.command = {simulation::CommandKind::TakeShot, 0, 0, 30, -5};
  if (now.tick + 1 == last) input.command = {simulation::CommandKind::Finish};
  return input;
}

/// What a station does for one exercise, without its threads.
class ScriptedExercise {
 public:
  explicit ScriptedExercise(const std::filesystem::path& records, std::uint64_t fingerprint = 0)
      : setup_(make_setup()),
        start_(begin_anew(
            simulation::test::wrist(),
            fingerprint != 0 ? fingerprint : simulation::fingerprint_of(simulation::test::wrist()),
            setup_,
            records)) {
    start_.journal->note_owner("first");
  }

  /// @param world, shadow  that have not begun: making them takes longer than an exercise.
  ScriptedExercise(const std::filesystem::path& records,
                   std::uint64_t fingerprint,
                   simulation::World world,
                   simulation::World shadow)
      : setup_(make_setup()),
        start_(begin_anew(simulation::test::wrist(),
                          fingerprint,
                          setup_,
                          records,
                          std::move(world),
                          std::move(shadow))) {
    start_.journal->note_owner("first");
  }

  /// One tick of an exercise of so many. @param command  instead of the script's.
  void step(Tick last, const simulation::Command& command = {}) {
    simulation::Input input = scripted_input(start_.world.now(), last);
    if (command.kind != simulation::CommandKind::None) input.command = command;
    start_.recorder.append(input);
    const simulation::Snapshot& now = start_.world.step(input);
    std::vector<protocol::LoggedEvent> events;
    for (std::size_t i = 0; i < now.event_count; ++i) {
      const bool is_shot = now.events[i].kind == simulation::EventKind::ShotTaken;
      events.push_back({static_cast<std::int64_t>(now.tick), is_shot ? "shot_taken" : "other", ""});
    }
    ExerciseJournal& journal = *start_.journal;
    journal.append(input);
    journal.append(events);
    start_.log.insert(start_.log.end(), events.begin(), events.end());
    if (now.tick % simulation::kKeyframeTicks == 0) {
      const simulation::Keyframe keyframe{now.tick, start_.world.write_state()};
      journal.append(keyframe, now.state_hash);
      start_.recorder.append_keyframe(keyframe);
    }
    journal.hand_over(now.state_hash);
  }

  /// The attempt as it is now; the journal has all of it.
  [[nodiscard]] records::Attempt end() {
    const simulation::Snapshot& now = start_.world.now();
    start_.journal->hand_over_now(now.state_hash);
    const auto recording = start_.recorder.finished(now.state_hash);
    std::optional<procedure::ScoreReport> score;
    if (now.finished) {
      score = setup_.procedure->score(simulation::test::wrist(), start_.world.operation_record());
    }
    return make_attempt({simulation::test::wrist(), recording, start_.log, std::move(score),
                         setup_.trainee, setup_.input_device, start_.started_at, start_.origin});
  }

  [[nodiscard]] const simulation::Snapshot& now() const { return start_.world.now(); }
  [[nodiscard]] ExerciseJournal& journal() { return *start_.journal; }
  [[nodiscard]] std::unique_ptr<ExerciseJournal> take_journal() {
    return std::move(start_.journal);
  }
  [[nodiscard]] const std::string& origin() const { return start_.origin; }

 private:
  static constexpr std::uint64_t kSeed = 7;

  static ExerciseSetup make_setup() {
    ExerciseSetup setup;
    setup.trainee = "Ada";
    setup.input_device = "script";
    setup.procedure = &simulation::test::exercise();
    setup.seed = kSeed;
    setup.number = 1234567;
    return setup;
  }

  ExerciseSetup setup_;
  ExerciseStart start_;
};

}  // namespace carpus::server::testing
