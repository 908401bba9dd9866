// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_tick_command.hpp"

#include <sys/utsname.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "cli/tick_scenes.hpp"
#include "core/error.hpp"
#include "procedures/built_in.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct BenchTickArguments {
  std::string case_folder = kDefaultCase;
  std::string procedure;
  double seconds = 20.0;
  std::string json;
};

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

constexpr float kTickMicroseconds = 1000.0F;

nlohmann::ordered_json row_of(const std::string& name, SceneTimes times) {
  auto& sorted = times.microseconds;
  std::sort(sorted.begin(), sorted.end());
  const auto over =
      sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), kTickMicroseconds);
  return {{"case", name},
          {"scene", times.scene},
          {"ticks", sorted.size()},
          {"p50_us", percentile(sorted, 0.5)},
          {"p99_us", percentile(sorted, 0.99)},
          {"p999_us", percentile(sorted, 0.999)},
          {"worst_us", static_cast<double>(sorted.back())},
          {"ticks_over_1ms", over}};
}

nlohmann::ordered_json figures_of(const cases::CaseData& data,
                                  const procedure::Procedure& procedure,
                                  TickBench bench) {
  auto rows = nlohmann::ordered_json::array();
  for (SceneTimes& times : bench.scenes) rows.push_back(row_of(data.pseudonym, std::move(times)));
  return {{"case", data.pseudonym},
          {"case_simulated", data.provenance.simulated},
          {"bones", data.bones.size()},
          {"procedure", procedure.id},
          {"rows", std::move(rows)},
          {"set_up_ms", bench.costs.set_up_ms},
          {"undo_us", bench.costs.undo_us},
          {"memory_mib", bench.costs.memory_mib},
          {"replay_speed", bench.costs.replay_speed},
          {"recording_bytes_per_s", bench.costs.recording_bytes_per_s},
          {"unresolved_contacts", bench.unresolved_contacts},
          {"machine", machine_name()},
          {"compiler", kCompiler},
          {"flags", build_flags()}};
}

void print(const cases::CaseData& data, const nlohmann::ordered_json& f) {
  std::printf("processor time of one simulation tick on %s (%d bones), %s\n",
              in_words(data).c_str(), f["bones"].get<int>(),
              f["procedure"].get<std::string>().c_str());
  std::printf("%-22s %9s %10s %10s %10s %10s %9s\n", "scene", "ticks", "p50 us", "p99 us",
              "p99.9 us", "worst us", "over 1 ms");
  for (const auto& row : f["rows"]) {
    std::printf("%-22s %9zu %10.2f %10.2f %10.2f %10.2f %9lld\n",
                row["scene"].get<std::string>().c_str(), row["ticks"].get<std::size_t>(),
                row["p50_us"].get<double>(), row["p99_us"].get<double>(),
                row["p999_us"].get<double>(), row["worst_us"].get<double>(),
                row["ticks_over_1ms"].get<long long>());
  }
  std::printf("set-up %.0f ms, undo %.0f us (worst), %.1f MiB an exercise beyond the case\n",
              f["set_up_ms"].get<double>(), f["undo_us"].get<double>(),
              f["memory_mib"].get<double>());
  std::printf("replay %.0f times real time, recording %.0f bytes a second\n",
              f["replay_speed"].get<double>(), f["recording_bytes_per_s"].get<double>());
  std::printf("machine: %s\ncompiler: %s\nflags: %s\n", f["machine"].get<std::string>().c_str(),
              f["compiler"].get<std::string>().c_str(), f["flags"].get<std::string>().c_str());
}

void run(const BenchTickArguments& arguments) {
  if (!(arguments.seconds >= 1.0 && arguments.seconds <= 3600.0)) {
    throw UsageError("bench tick: --seconds is " + std::to_string(arguments.seconds) +
                     "; give 1 to 3600 seconds of simulated time");
  }
  const cases::CaseData data = load_case(arguments.case_folder);
  const procedure::Procedure& procedure = arguments.procedure.empty()
                                              ? *procedures::built_in().all().front()
                                              : find_procedure(arguments.procedure);
  const auto ticks = static_cast<std::size_t>(arguments.seconds * 1000.0);
  const nlohmann::ordered_json figures =
      figures_of(data, procedure, time_ticks(data, procedure, ticks));
  print(data, figures);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, figures.dump(2) + "\n");
  }
}

}  // namespace

void add_bench_tick_command(CLI::App& bench) {
  auto arguments = std::make_shared<BenchTickArguments>();
  CLI::App* command = bench.add_subcommand("tick", "Time one simulation tick in several scenes");
  command->add_option("--case", arguments->case_folder, "Case folder")->capture_default_str();
  command->add_option("--procedure", arguments->procedure,
                      "What is operated; the first when empty");
  command
      ->add_option("--seconds", arguments->seconds, "Simulated time to measure in each scene [s]")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
