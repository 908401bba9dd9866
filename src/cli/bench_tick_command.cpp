// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Operations by scripted trainees, expert and novice in turn, until enough seconds of simulated
// time are done; each World::step is timed by itself, the trainee's own work is not. One operation
// runs first and is not counted.
#include "cli/bench_tick_command.hpp"

#include <sys/utsname.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/operation_files.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"
#include "simulation/world.hpp"
#include "trainee/scripted_trainee.hpp"

namespace carpus::cli {
namespace {

struct BenchTickArguments {
  std::string case_folder = kDefaultCase;
  double seconds = 120.0;
  std::string json;
};

struct TickTimes {
  std::vector<float> microseconds;  ///< one a tick
  std::size_t operations = 0;
  std::uint64_t unresolved_contacts = 0;
};

/// One operation; its ticks are appended to `times`, up to `wanted` of them.
void operate(const cases::CaseData& posed_case,
             trainee::Skill skill,
             std::uint64_t seed,
             std::size_t wanted,
             TickTimes& times) {
  using Clock = std::chrono::steady_clock;
  simulation::World world(posed_case, procedure::ProcedureId::DorsalScaphoidFixation, seed);
  trainee::ScriptedTrainee hand(posed_case, skill, seed);
  while (!world.now().finished && times.microseconds.size() < wanted) {
    const simulation::Input input = hand.next(world.now());
    const auto start = Clock::now();
    world.step(input);
    const auto end = Clock::now();
    times.microseconds.push_back(std::chrono::duration<float, std::micro>(end - start).count());
  }
  ++times.operations;
  times.unresolved_contacts += world.faults().unresolved_contacts;
}

/// First line of /proc/cpuinfo that names the processor, or the machine's architecture.
std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  utsname names{};
  return ::uname(&names) == 0 ? names.machine : "unknown";
}

std::string build_flags() {
#if defined(__OPTIMIZE__)
  std::string flags = "optimised";
#else
  std::string flags = "not optimised";
#endif
#if defined(NDEBUG)
  flags += ", without assertions";
#else
  flags += ", with assertions";
#endif
  return flags + ", -ffp-contract=off";
}

/// The smallest time that `share` of all ticks do not exceed; `sorted` ascending, not empty.
double percentile(const std::vector<float>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
  return static_cast<double>(sorted[std::min(rank, sorted.size() - 1)]);
}

#ifdef __clang__
constexpr const char* kCompiler = __VERSION__;  // names itself
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

nlohmann::ordered_json figures_of(const cases::CaseData& posed_case, TickTimes times) {
  std::sort(times.microseconds.begin(), times.microseconds.end());
  const auto& sorted = times.microseconds;
  const auto over = [&](float limit) {
    return sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), limit);
  };
  constexpr float kTickMicroseconds = 1000.0F;
  return {{"case", posed_case.pseudonym},
          {"case_simulated", posed_case.provenance.simulated},
          {"bones", posed_case.bones.size()},
          {"ticks", sorted.size()},
          {"operations", times.operations},
          {"p50_us", percentile(sorted, 0.5)},
          {"p99_us", percentile(sorted, 0.99)},
          {"p999_us", percentile(sorted, 0.999)},
          {"worst_us", static_cast<double>(sorted.back())},
          {"ticks_over_1ms", over(kTickMicroseconds)},
          {"unresolved_contacts", times.unresolved_contacts},
          {"machine", machine_name()},
          {"compiler", kCompiler},
          {"flags", build_flags()}};
}

void print(const cases::CaseData& posed_case, const nlohmann::ordered_json& f) {
  std::printf("one simulation tick on %s (%d bones), %zu ticks of %d scripted operations\n",
              in_words(posed_case).c_str(), f["bones"].get<int>(), f["ticks"].get<std::size_t>(),
              f["operations"].get<int>());
  std::printf("%12s %12s %12s %12s %16s\n", "p50 us", "p99 us", "p99.9 us", "worst us",
              "ticks over 1 ms");
  std::printf("%12.2f %12.2f %12.2f %12.2f %16lld\n", f["p50_us"].get<double>(),
              f["p99_us"].get<double>(), f["p999_us"].get<double>(), f["worst_us"].get<double>(),
              f["ticks_over_1ms"].get<long long>());
  std::printf("machine: %s\ncompiler: %s\nflags: %s\n", f["machine"].get<std::string>().c_str(),
              f["compiler"].get<std::string>().c_str(), f["flags"].get<std::string>().c_str());
}

void run(const BenchTickArguments& arguments) {
  if (!(arguments.seconds >= 1.0 && arguments.seconds <= 3600.0)) {
    throw UsageError("bench tick: --seconds is " + std::to_string(arguments.seconds) +
                     "; give 1 to 3600 seconds of simulated time");
  }
  const cases::CaseData posed_case = load_posed_case(arguments.case_folder);
  TickTimes warm_up;
  operate(posed_case, trainee::Skill::Expert, 1, SIZE_MAX, warm_up);
  const auto wanted = static_cast<std::size_t>(arguments.seconds * 1000.0);
  TickTimes times;
  times.microseconds.reserve(wanted);
  for (std::uint64_t seed = 1; times.microseconds.size() < wanted; ++seed) {
    operate(posed_case, seed % 2 == 1 ? trainee::Skill::Expert : trainee::Skill::Novice, seed,
            wanted, times);
  }
  const nlohmann::ordered_json figures = figures_of(posed_case, std::move(times));
  print(posed_case, figures);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, figures.dump(2) + "\n");
  }
}

}  // namespace

void add_bench_tick_command(CLI::App& bench) {
  auto arguments = std::make_shared<BenchTickArguments>();
  CLI::App* command =
      bench.add_subcommand("tick", "Time one simulation tick of a scripted operation");
  command->add_option("--case", arguments->case_folder, "Case folder")->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "Simulated time to measure [s]")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
