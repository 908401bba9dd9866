// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_journal_command.hpp"

#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "procedures/built_in.hpp"
#include "records/atomic_file.hpp"
#include "records/journals_left_behind.hpp"
#include "server/exercise.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

struct BenchJournalArguments {
  std::string case_folder = kDefaultCase;
  std::string folder = ".";
  double seconds = 8.0;
  std::string json;
};

/// As often as a station looks.
constexpr milliseconds kCollect{16};
constexpr Tick kHour = 3'600'000;

double processor_s(::clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// A hand's way: up to some 300 mm/s, turning, trembling.
class WanderingHand {
 public:
  explicit WanderingHand(std::uint64_t seed) : rng_(seed) {}
  void move(simulation::HandInput& hand, double ms) {
    for (std::size_t k = 0; k < 3; ++k) {
      velocity_[k] = std::clamp(velocity_[k] + 0.01 * rng_.normal(), -0.3, 0.3);
      hand.tip_in_patient[k] =
          std::clamp(hand.tip_in_patient[k] + velocity_[k] * ms, -150.0, 150.0);
      hand.shaft_in_patient[k] += 0.002 * rng_.normal();
    }
  }

 private:
  Rng rng_;
  Vec3 velocity_;
};

/// Who operates: how often, with how many hands.
struct Operator {
  const char* name;
  milliseconds interval;
  std::size_t hands;
  simulation::Guidance guidance;
};
constexpr std::array<Operator, 2> kOperators{{
    {"a page's hand", milliseconds(16), 1, simulation::Guidance::Planned},
    {"two arms at 1 kHz", milliseconds(1), 2, simulation::Guidance::Direct},
}};

/// A live exercise, operated for so long.
struct LiveRun {
  server::TickTiming timing;
  simulation::Recording recording;
  std::uint64_t journal_bytes = 0;
  std::uint64_t most_behind_ticks = 0;  ///< that a power cut would have taken
};

/// @param records  beside which the journal lies; empty: it has none.
LiveRun operate(const cases::CaseData& data,
                const procedure::Procedure& procedure,
                const Operator& who,
                double seconds,
                const fs::path& records) {
  server::ExerciseSetup setup;
  setup.input_device = "script";
  setup.procedure = &procedure;
  setup.seed = 1;
  server::Exercise exercise(data, setup, server::begin_anew(data, 1, setup, records));
  std::vector<WanderingHand> hands;
  for (std::size_t h = 0; h < who.hands; ++h) hands.emplace_back(h + 1);
  (void)exercise.update();
  session::HeldInput held = session::resting(exercise.state().snapshot);
  for (std::size_t h = 0; h < who.hands; ++h) held.hands[h].guidance = who.guidance;
  LiveRun run;
  const auto begin = steady_clock::now();
  const auto end = begin + std::chrono::duration_cast<steady_clock::duration>(
                               std::chrono::duration<double>(seconds));
  auto collect_at = begin;
  for (auto due = begin; due < end; due += who.interval) {
    std::this_thread::sleep_until(due);
    for (std::size_t h = 0; h < who.hands; ++h) {
      hands[h].move(held.hands[h], static_cast<double>(who.interval.count()));
      ++held.heard[h];
    }
    exercise.loop().hold(held);
    if (due < collect_at) continue;
    collect_at += kCollect;
    (void)exercise.collect();
    (void)exercise.update();
    if (const auto disk = exercise.on_disk()) {
      const std::uint64_t behind =
          exercise.state().snapshot.tick -
          std::min<std::uint64_t>(disk->safe, exercise.state().snapshot.tick);
      run.most_behind_ticks = std::max(run.most_behind_ticks, behind);
    }
  }
  const records::Attempt attempt = exercise.end();
  run.timing = exercise.state().timing;
  run.recording = simulation::decode(attempt.recording).value();
  if (const auto journal = exercise.take_journal()) {
    (void)journal->wait_until_safe(milliseconds(5000));
    run.journal_bytes = journal->progress().written_bytes;
    if (!journal->progress().problem.empty()) throw IoError(journal->progress().problem);
    journal->remove();
  }
  return run;
}

/// What the journal alone takes of a processor at true speed, its thread included [1 = a core].
double share_of_a_core(const simulation::Recording& recording, const fs::path& file) {
  std::optional<server::ExerciseJournal> journal(std::in_place, file, protocol::RunningExercise{},
                                                 simulation::Recording{});
  const auto begin = steady_clock::now();
  const double process_before = processor_s(CLOCK_PROCESS_CPUTIME_ID);
  const double thread_before = processor_s(CLOCK_THREAD_CPUTIME_ID);
  double here = 0.0;
  Tick tick = 0;
  std::size_t keyframe = 0;
  for (const simulation::InputRun& run : recording.runs) {
    for (std::uint32_t i = 0; i < run.ticks; ++i) {
      const double before = processor_s(CLOCK_THREAD_CPUTIME_ID);
      journal->append(run.input);
      ++tick;
      if (keyframe < recording.keyframes.size() && recording.keyframes[keyframe].tick == tick) {
        journal->append(recording.keyframes[keyframe++], 1);
      }
      if (tick % static_cast<Tick>(kCollect.count()) == 0) journal->hand_over(1);
      here += processor_s(CLOCK_THREAD_CPUTIME_ID) - before;
      if (tick % static_cast<Tick>(kCollect.count()) == 0) {
        std::this_thread::sleep_until(begin + milliseconds(tick));
      }
    }
  }
  (void)journal->wait_until_safe(milliseconds(5000));
  const double wall = std::chrono::duration<double>(steady_clock::now() - begin).count();
  const double process = processor_s(CLOCK_PROCESS_CPUTIME_ID) - process_before;
  const double thread = processor_s(CLOCK_THREAD_CPUTIME_ID) - thread_before;
  journal->remove();
  return (here + std::max(0.0, process - thread)) / wall;
}

/// What reading an hour back takes.
struct HourRead {
  double seconds = 0.0;
  double file_mib = 0.0;
  double kept_mib = 0.0;  ///< in memory by the exercise that comes back
  double most_mib = 0.0;  ///< of memory that the whole process had at once
};

/// What the program has asked for and not given back. Resident memory would not tell: the
/// allocator keeps what was given back.
double allocated_mib() {
  const auto held = ::mallinfo2();
  return static_cast<double>(held.uordblks + held.hblkhd) / (1 << 20);
}

double most_memory_mib() {
  constexpr std::string_view kName = "VmHWM:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(kName)) return std::stod(line.substr(kName.size())) / 1024;
  }
  return 0.0;
}

/// Writes what an hour of such inputs leaves, a keyframe every ten seconds.
void write_an_hour(const simulation::Recording& recording,
                   std::vector<std::byte> keyframe,
                   const fs::path& file) {
  server::ExerciseJournal journal(file, protocol::RunningExercise{}, simulation::Recording{});
  simulation::Keyframe state{0, std::move(keyframe)};
  for (Tick tick = 0; tick < kHour;) {
    for (const simulation::InputRun& run : recording.runs) {
      for (std::uint32_t i = 0; i < run.ticks && tick < kHour; ++i) {
        journal.append(run.input);
        ++tick;
        if (tick % server::ExerciseJournal::kPartTicks == 0) journal.hand_over_now(1);
        if (tick % simulation::kKeyframeTicks != 0) continue;
        state.tick = tick;
        journal.append(state, 1);
        (void)journal.wait_until_safe(milliseconds(5000));
      }
    }
  }
  (void)journal.wait_until_safe(milliseconds(5000));
}

/// Reads it as a station that is started again does, up to where it can be gone on with from the
/// last keyframe.
HourRead read_an_hour(const fs::path& records) {
  HourRead read;
  const fs::path file = records::journal_path(records, "hour");
  read.file_mib = static_cast<double>(fs::file_size(file)) / (1 << 20);
  std::ofstream("/proc/self/clear_refs") << 5;  // forgets the most that there was
  const double before = allocated_mib();
  const auto begin = steady_clock::now();
  std::vector<std::string> problems;
  std::optional<Result<server::JournaledExercise>> exercise;
  for (records::FoundJournal& found : records::find_journals(records, problems)) {
    if (found.place.file == file) exercise = server::read_exercise(found.content);
  }
  read.seconds = std::chrono::duration<double>(steady_clock::now() - begin).count();
  read.most_mib = most_memory_mib();
  read.kept_mib = allocated_mib() - before;
  fs::remove(file);
  if (!exercise || !*exercise || (*exercise)->recording.tick_count() != kHour) {
    throw IoError("bench journal: the journal of an hour does not come back" +
                  (exercise && !*exercise ? ": " + exercise->error() : std::string()));
  }
  return read;
}

nlohmann::ordered_json row_of(const cases::CaseData& data,
                              const procedure::Procedure& procedure,
                              const Operator& who,
                              const BenchJournalArguments& arguments,
                              const fs::path& records) {
  const LiveRun without = operate(data, procedure, who, arguments.seconds, {});
  const LiveRun with = operate(data, procedure, who, arguments.seconds, records);
  std::uint64_t keyframe_bytes = 0;
  for (const simulation::Keyframe& each : with.recording.keyframes) {
    keyframe_bytes += each.state.size();
  }
  const double simulated_s = static_cast<double>(with.recording.tick_count()) * kTickSeconds;
  const double share = share_of_a_core(
      with.recording, records.parent_path() / ("bench." + std::to_string(::getpid()) + ".journal"));
  const std::vector<std::byte> keyframe = simulation::World(data, procedure, 1).write_state();
  const auto one_keyframe = static_cast<double>(keyframe.size());
  write_an_hour(with.recording, keyframe, records::journal_path(records, "hour"));
  const HourRead hour = read_an_hour(records);
  return {{"input", who.name},
          {"simulated_s", simulated_s},
          {"bytes_per_s", static_cast<double>(with.journal_bytes - keyframe_bytes) / simulated_s},
          {"keyframe_bytes_per_s",
           one_keyframe / (static_cast<double>(simulation::kKeyframeTicks) * kTickSeconds)},
          {"share_of_a_core", share},
          {"most_behind_ms", with.most_behind_ticks},
          {"read_an_hour_s", hour.seconds},
          {"an_hour_mib", hour.file_mib},
          {"an_hour_kept_mib", hour.kept_mib},
          {"read_an_hour_process_mib", hour.most_mib},
          {"tick_p50_us", {without.timing.whole_p50_us, with.timing.whole_p50_us}},
          {"tick_p99_us", {without.timing.whole_p99_us, with.timing.whole_p99_us}},
          {"late_ticks", {without.timing.late_ticks, with.timing.late_ticks}}};
}

void print(const nlohmann::ordered_json& row) {
  std::printf(
      "%-20s %9.0f %12.0f %9.2f %% %9llu ms %7.2f s %5.0f / %3.0f / %-4.0f  %6.1f / %-6.1f %6.1f / "
      "%-6.1f %5llu / %llu\n",
      row["input"].get<std::string>().c_str(), row["bytes_per_s"].get<double>(),
      row["keyframe_bytes_per_s"].get<double>(), 100.0 * row["share_of_a_core"].get<double>(),
      row["most_behind_ms"].get<unsigned long long>(), row["read_an_hour_s"].get<double>(),
      row["an_hour_mib"].get<double>(), row["an_hour_kept_mib"].get<double>(),
      row["read_an_hour_process_mib"].get<double>(), row["tick_p50_us"][0].get<double>(),
      row["tick_p50_us"][1].get<double>(), row["tick_p99_us"][0].get<double>(),
      row["tick_p99_us"][1].get<double>(), row["late_ticks"][0].get<unsigned long long>(),
      row["late_ticks"][1].get<unsigned long long>());
}

void run(const BenchJournalArguments& arguments) {
  if (!(arguments.seconds >= 1.0 && arguments.seconds <= 600.0)) {
    throw UsageError("bench journal: --seconds is " + std::to_string(arguments.seconds) +
                     "; give 1 to 600 seconds");
  }
  const cases::CaseData data = load_case(arguments.case_folder);
  const procedure::Procedure& procedure = *procedures::built_in().all().front();
  std::printf("the journal of a live exercise on %s, %s, at %s\n", in_words(data).c_str(),
              procedure.id.c_str(), arguments.folder.c_str());
  constexpr const char* kHeads = "%-20s %9s %12s %11s %12s %9s %-18s  %-15s %-15s %s\n";
  std::printf(kHeads, "input", "bytes/s", "+ keyframes", "of a core", "most behind", "an hour",
              "disk/kept/process", "tick p50 us", "tick p99 us", "late ticks");
  std::printf(kHeads, "", "", "", "", "", "read in", "MiB", "without / with", "without / with",
              "without / with");
  auto rows = nlohmann::ordered_json::array();
  const fs::path records = fs::path(arguments.folder) / "bench.sqlite";
  for (const Operator& who : kOperators) {
    rows.push_back(row_of(data, procedure, who, arguments, records));
    print(rows.back());
  }
  if (!arguments.json.empty()) {
    const nlohmann::ordered_json json{{"case", data.pseudonym},
                                      {"case_simulated", data.provenance.simulated},
                                      {"procedure", procedure.id},
                                      {"rows", rows}};
    records::write_file_atomically(arguments.json, json.dump(2) + "\n");
  }
}

}  // namespace

void add_bench_journal_command(CLI::App& bench) {
  auto arguments = std::make_shared<BenchJournalArguments>();
  CLI::App* command =
      bench.add_subcommand("journal", "Measure what it costs to have an exercise on disk");
  command->add_option("--case", arguments->case_folder, "Case folder")->capture_default_str();
  command->add_option("--folder", arguments->folder, "Where the journals are written")
      ->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "True time of each run [s]")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
