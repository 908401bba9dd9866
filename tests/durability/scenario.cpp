// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "scenario.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <vector>

#include "records/attempt_keeper.hpp"
#include "records/journals_left_behind.hpp"
#include "server/journal_test_support.hpp"
#include "server/journal_watch.hpp"
#include "server/recovery.hpp"

namespace carpus::durability {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using server::testing::ScriptedExercise;
using simulation::World;
using simulation::test::exercise;
using simulation::test::wrist;

constexpr std::uint64_t kMostLost = 1000;

fs::path records_in(const fs::path& folder) { return folder / "attempts.sqlite"; }

std::uint64_t fingerprint() {
  static const std::uint64_t made = simulation::fingerprint_of(wrist());
  return made;
}

/// Worlds that the next process uses up.
std::vector<World>& worlds() {
  static std::vector<World> made;
  return made;
}

World next_world() {
  World world = std::move(worlds().back());
  worlds().pop_back();
  return world;
}

std::optional<ScriptedExercise> begin_exercise(const fs::path& folder, Progress& progress) {
  const int number = progress.begun;
  std::optional<ScriptedExercise> begun(std::in_place, records_in(folder), fingerprint(),
                                        next_world(), next_world());
  std::copy(begun->origin().begin(), begun->origin().end(),
            progress.exercises[static_cast<std::size_t>(number)].origin.begin());
  progress.begun = number + 1;
  return begun;
}

/// As the station: where the disk is behind, time stands still.
void do_ticks(ScriptedExercise& running,
              std::atomic<std::uint64_t>& ticks,
              std::uint64_t count,
              std::uint64_t last) {
  server::JournalWatch watch;
  while (running.now().tick < count) {
    while (watch
               .look(running.journal().progress(), running.now().tick,
                     std::chrono::steady_clock::now())
               .holds_time) {
      std::this_thread::sleep_for(200us);
    }
    running.step(last);
    ticks = running.now().tick;
  }
}

/// How often each origin is in the records; throws for one that cannot be read whole.
std::map<std::string, int> stored_in(const records::AttemptKeeper& keeper, std::string& fault) {
  std::map<std::string, int> stored;
  for (const records::AttemptSummary& summary : keeper.list()) {
    ++stored[summary.origin];
    const auto attempt = keeper.find(summary.id);
    const auto recording =
        simulation::decode(attempt ? attempt->recording : std::vector<std::byte>{});
    if (!recording || recording->tick_count() != summary.duration_ticks) {
      fault = "an attempt is half written";
    }
    if (summary.outcome == records::Outcome::Finished && attempt->score_json.empty()) {
      fault = "a finished attempt lost its score";
    }
  }
  return stored;
}

}  // namespace

SharedProgress::SharedProgress() {
  void* const memory =
      ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  progress_ = new (memory) Progress;
}

SharedProgress::~SharedProgress() { ::munmap(progress_, sizeof(Progress)); }

void SharedProgress::copy_from(const SharedProgress& other) const {
  for (std::size_t i = 0; i < kExercises; ++i) {
    const Progress::OfExercise& from = other->exercises[i];
    Progress::OfExercise& to = progress_->exercises[i];
    to.is_stored = from.is_stored.load();
    to.is_over = from.is_over.load();
    to.ticks = from.ticks.load();
    to.origin = from.origin;
  }
  progress_->begun = other->begun.load();
}

void prepare() {
  (void)fingerprint();
  while (worlds().size() < std::size_t{2} * kExercises)
    worlds().emplace_back(wrist(), exercise(), 7);
}

std::size_t operate(const fs::path& folder, Progress& progress, std::uint64_t last_ticks) {
  records::AttemptKeeper keeper(records_in(folder), {}, {200ms, 50ms});
  std::optional<ScriptedExercise> running = begin_exercise(folder, progress);
  while (progress.begun < kExercises) {
    Progress::OfExercise& mine = progress.exercises[static_cast<std::size_t>(progress.begun - 1)];
    do_ticks(*running, mine.ticks, kFinishedTicks, kFinishedTicks);
    records::Attempt attempt = running->end();
    std::shared_ptr<server::ExerciseJournal> journal = running->take_journal();
    mine.is_over = true;
    keeper.save(std::move(attempt), [&mine, journal](const records::KeptAttempt& kept) {
      if (!kept.is_on_disk) return;
      journal->remove();
      mine.is_stored = true;
    });
    // The next begins while the one before is being stored.
    running = begin_exercise(folder, progress);
  }
  Progress::OfExercise& mine = progress.exercises[kExercises - 1];
  do_ticks(*running, mine.ticks, last_ticks, 0);
  return keeper.settle();
}

Found start_anew(const fs::path& folder, const Progress& before) {
  Found found;
  static const procedure::ProcedureList procedures({&exercise()});
  records::AttemptKeeper keeper(records_in(folder));
  if (keeper.settle() != 0) found.fault = "a rescued attempt was not taken back";
  server::LeftBehind left = server::look_for_what_was_left(
      wrist(), fingerprint(), procedures, records_in(folder),
      [&](const std::string& origin) { return keeper.holds(origin); }, 1);
  for (server::AttemptLeftBehind& each : left.ended) {
    const auto kept = keeper.save(each.attempt);
    if (!kept.is_on_disk) found.fault = "what was left could not be stored: " + kept.problem;
    each.journal->remove();
  }
  const std::map<std::string, int> stored = stored_in(keeper, found.fault);
  found.went_on = left.running != nullptr;
  for (int i = 0; i < before.begun; ++i) {
    const Progress::OfExercise& was = before.exercises[static_cast<std::size_t>(i)];
    const std::string origin = was.origin.data();
    const auto in_records = stored.find(origin);
    const bool goes_on = found.went_on && left.running->start.origin == origin;
    if (in_records != stored.end()) {
      if (in_records->second > 1) found.fault = "an attempt is stored twice";
      if (goes_on) found.fault = "a stored attempt goes on";
    }
    if (was.is_stored && in_records == stored.end()) found.fault = "a stored attempt is lost";
    if (was.is_stored || was.is_over) continue;
    // It was running.
    std::uint64_t kept = 0;
    if (goes_on) kept = left.running->start.world.now().tick;
    if (in_records != stored.end()) kept = was.ticks;
    found.lost_ticks = was.ticks > kept ? was.ticks - kept : 0;
    if (found.lost_ticks > kMostLost) {
      found.fault =
          "of " + std::to_string(was.ticks) + " ticks " + std::to_string(kept) + " are left";
    }
  }
  return found;
}

}  // namespace carpus::durability
