// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/recovery.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "records/journals_left_behind.hpp"
#include "records/utc_time.hpp"

namespace carpus::server {

namespace {

using simulation::World;

/// A journal that could be read.
struct Readable {
  JournaledExercise exercise;
  records::JournalPlace place;
  std::string last_written;  ///< UTC, ISO 8601
};

/// "3 min 12 s"
std::string duration(Tick ticks) {
  const Tick seconds = ticks / 1000;
  return (seconds < 60 ? "" : std::to_string(seconds / 60) + " min ") +
         std::to_string(seconds % 60) + " s";
}

std::string name_of(const JournaledExercise& exercise) {
  return "an exercise begun at " + exercise.head.started_at + ", " +
         duration(exercise.recording.tick_count()) + " long";
}

/// A world where a journal ends.
struct WorldAtEnd {
  World world;
  std::size_t keyframes = 0;  ///< as many of the recording's first ones lead there
};

bool is_undone_after(const simulation::Recording& recording, Tick tick) {
  return std::any_of(recording.runs.at(tick), recording.runs.end(),
                     [](const auto& run) { return simulation::goes_back(run.input.command.kind); });
}

/// Proved by its hash; or why there is none. Where a keyframe is refused, or undo went back beyond
/// it, an earlier one leads there, or the beginning: each try goes twice as far back.
Result<WorldAtEnd> world_at_end(const cases::CaseData& data,
                                const procedure::Procedure& procedure,
                                const simulation::Recording& recording) {
  WorldAtEnd end{World(data, procedure, recording.seed, recording.mode, recording.prepared),
                 recording.keyframes.size()};
  for (std::size_t back = 1;; back *= 2) {
    const auto reached =
        simulation::seek(end.world, recording, recording.tick_count(), end.keyframes);
    if (reached && end.world.now().state_hash == recording.end_hash) return end;
    const bool can_try_again =
        end.keyframes > 0 &&
        (!reached || is_undone_after(recording, recording.keyframes[end.keyframes - 1].tick));
    if (!can_try_again) {
      return Refusal{reached ? "its inputs do not lead to its state; it was recorded by " +
                                   recording.program_version
                             : reached.error()};
    }
    end.keyframes -= std::min(end.keyframes, back);
  }
}

simulation::Input last_input(const simulation::Recording& recording) {
  return recording.runs.back().input;
}

/// The input of the tick after this one.
simulation::Input input_after(const simulation::Recording& recording, Tick tick) {
  const auto run = recording.runs.at(tick);
  return run == recording.runs.end() ? last_input(recording) : run->input;
}

/// The last pictures that were taken, oldest first: their ticks are stepped again.
std::vector<TakenShot> last_pictures(World& world,
                                     const JournaledExercise& exercise,
                                     std::size_t keyframes,
                                     std::size_t most) {
  std::vector<TakenShot> pictures;
  Tick before = 0;
  for (auto event = exercise.log.rbegin(); event != exercise.log.rend(); ++event) {
    if (pictures.size() >= most) break;
    const auto tick = static_cast<Tick>(event->tick);
    if ((event->kind != "shot_taken" && event->kind != "live_ended") || tick == 0) continue;
    if (std::exchange(before, tick) == tick) continue;
    if (!simulation::seek(world, exercise.recording, tick - 1, keyframes)) break;
    const simulation::Input input = input_after(exercise.recording, tick - 1);
    const auto taken =
        pictures_of(world.procedure(), EventfulTick{input.command, world.step(input)});
    pictures.insert(pictures.end(), taken.rbegin(), taken.rend());
  }
  std::reverse(pictures.begin(), pictures.end());
  return pictures;
}

AttemptLeftBehind stored_as_it_is(Readable&& readable,
                                  const cases::CaseData& data,
                                  const World* world) {
  const protocol::RunningExercise& head = readable.exercise.head;
  const simulation::Recording& recording = readable.exercise.recording;
  std::optional<procedure::ScoreReport> score;
  if (world != nullptr && world->now().finished) {
    score = world->procedure().score(data, world->operation_record());
  }
  AttemptLeftBehind left{
      make_attempt({data, recording, readable.exercise.log, std::move(score), head.trainee,
                    head.input_device, head.started_at, head.origin}),
      nullptr};
  // It may be of another case than the one that is open.
  left.attempt.summary.case_name = head.case_;
  left.attempt.summary.case_simulated = head.case_simulated;
  left.attempt.summary.ended_at = readable.last_written;
  left.journal = std::make_shared<ExerciseJournal>(std::move(readable.place),
                                                   recording.tick_count(), last_input(recording));
  return left;
}

/// One tick in which nobody does anything and both worlds forget what undo would go back to: a
/// keyframe did not bring that, so whoever replays from the beginning must not have it either.
/// @return the hash after it.
std::uint64_t forget_checkpoints(simulation::Input input,
                                 World& world,
                                 World& shadow,
                                 simulation::Recording& recording) {
  for (simulation::HandInput& hand : input.hands) hand.driver = simulation::Driver::Off;
  input.c_arm.pedal_is_down = false;
  input.command = {simulation::CommandKind::ForgetCheckpoints};
  world.step(input);
  shadow.step(input);
  recording.runs.push_back({input, 1});
  return shadow.now().state_hash;
}

ResumedExercise gone_on_with(Readable&& readable,
                             const procedure::Procedure& procedure,
                             World&& world,
                             World&& shadow,
                             std::vector<TakenShot>&& shots) {
  JournaledExercise& exercise = readable.exercise;
  const Tick tick = exercise.recording.tick_count();
  const simulation::Input last = last_input(exercise.recording);
  const std::uint64_t hash = forget_checkpoints(last, world, shadow, exercise.recording);
  ExerciseSetup setup;
  setup.trainee = exercise.head.trainee;
  setup.input_device = exercise.head.input_device;
  setup.procedure = &procedure;
  setup.seed = exercise.recording.seed;
  setup.mode = exercise.recording.mode;
  setup.prepared = exercise.recording.prepared;
  setup.number = static_cast<std::uint64_t>(exercise.head.exercise);
  auto journal = std::make_unique<ExerciseJournal>(std::move(readable.place), tick, last);
  journal->note_owner(exercise.owner);
  // In the log, so that it is shown, and stored with the attempt.
  const std::vector<protocol::LoggedEvent> event{
      {static_cast<std::int64_t>(tick), "station_restarted",
       "The station was started again; at most the second before this is lost, and undo does not "
       "reach back before it."}};
  exercise.log.push_back(event.front());
  journal->append(event);
  journal->append(last_input(exercise.recording));
  journal->hand_over_now(hash);
  return {std::move(setup),
          {exercise.head.origin, exercise.head.started_at, std::move(world), std::move(shadow),
           simulation::Recorder(std::move(exercise.recording)), std::move(exercise.log),
           std::move(journal), true},
          std::move(exercise.owner),
          std::move(shots)};
}

/// Head and recording.
constexpr std::size_t kBlocksBeforeInputs = 2;

/// Whether a journal was cut off while it was begun: nothing is in it but what begins one.
bool is_a_beginning(const records::JournalContent& content) {
  constexpr std::uint64_t kMostBytes = 16384;
  return content.sound_size > 0 ? content.torn_bytes < kMostBytes : content.torn_bytes == 0;
}

/// The journals that can be read, newest first; the others are set aside.
std::vector<Readable> readable_ones(const std::filesystem::path& records,
                                    const std::function<bool(const std::string&)>& is_stored,
                                    std::vector<std::string>& words) {
  std::vector<Readable> readable;
  for (records::FoundJournal& found : records::find_journals(records, words)) {
    const auto head = read_head(found.content);
    if (head && is_stored(head->origin)) {
      // It was stored just before the program was killed.
      records::JournalWriter(std::move(found.place)).remove();
      continue;
    }
    const std::string file = found.place.file.string();
    if (found.content.blocks.size() < kBlocksBeforeInputs && is_a_beginning(found.content)) {
      words.push_back(file + ": an exercise in which nothing was done yet is deleted");
      records::JournalWriter(std::move(found.place)).remove();
      continue;
    }
    auto exercise = read_exercise(found.content);
    if (!exercise) {
      words.push_back(file + ": an exercise was left here that cannot be used: " +
                      exercise.error() + "; " + records::set_aside(std::move(found)));
    } else if (exercise->recording.tick_count() == 0) {
      words.push_back(file + ": an exercise in which nothing was done yet is deleted");
      records::JournalWriter(std::move(found.place)).remove();
    } else {
      if (found.content.torn_bytes > 0) {
        words.push_back(file + ": its last " + std::to_string(found.content.torn_bytes) +
                        " bytes were not written whole and are cut away");
      }
      readable.push_back({std::move(exercise.value()), std::move(found.place),
                          records::format_utc(found.last_written)});
    }
  }
  std::sort(readable.begin(), readable.end(), [](const Readable& a, const Readable& b) {
    return a.exercise.head.started_at > b.exercise.head.started_at;
  });
  return readable;
}

}  // namespace

LeftBehind look_for_what_was_left(const cases::CaseData& data,
                                  std::uint64_t case_fingerprint,
                                  const procedure::ProcedureList& procedures,
                                  const std::filesystem::path& records,
                                  const std::function<bool(const std::string&)>& is_stored,
                                  std::size_t shots) {
  LeftBehind left;
  left.words = records::clear_old_ones(records);
  for (Readable& each : readable_ones(records, is_stored, left.words)) {
    const simulation::Recording& recording = each.exercise.recording;
    const std::string name = name_of(each.exercise);
    const procedure::Procedure* procedure = procedures.find(recording.procedure);
    std::string why;
    if (recording.case_fingerprint != case_fingerprint) why = "it was made on another case";
    if (procedure == nullptr) why = "there is no procedure '" + recording.procedure + "' here";
    std::optional<World> world;
    std::size_t keyframes = 0;
    if (why.empty()) {
      auto reached = world_at_end(data, *procedure, recording);
      if (reached) {
        world.emplace(std::move(reached.value().world));
        keyframes = reached->keyframes;
      } else {
        why = reached.error();
      }
    }
    if (world && world->now().finished) why = "it was finished";
    if (why.empty() && left.running) why = "a newer one goes on";
    if (!why.empty()) {
      left.words.push_back(name + ", that was left running is stored as it is: " + why);
      left.ended.push_back(stored_as_it_is(std::move(each), data, world ? &*world : nullptr));
      continue;
    }
    World shadow(data, *procedure, recording.seed, recording.mode, recording.prepared);
    auto pictures = last_pictures(shadow, each.exercise, keyframes, shots);
    if (!simulation::seek(shadow, recording, recording.tick_count(), keyframes)) continue;
    left.words.push_back(name +
                         ", goes on where the station was stopped; at most its last second "
                         "is lost");
    left.running = std::make_unique<ResumedExercise>(gone_on_with(
        std::move(each), *procedure, std::move(*world), std::move(shadow), std::move(pictures)));
  }
  return left;
}

}  // namespace carpus::server
