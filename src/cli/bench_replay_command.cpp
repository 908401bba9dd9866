// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_replay_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/long_operation.hpp"
#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "procedures/built_in.hpp"
#include "records/atomic_file.hpp"
#include "records/attempt_keeper.hpp"
#include "records/utc_time.hpp"
#include "server/exercise.hpp"
#include "server/replay_desk.hpp"

namespace carpus::cli {
namespace {

struct BenchReplayArguments {
  std::string case_folder = kDefaultCase;
  std::string procedure;
  double minutes = 30.0;
  int seeks = 100;
  std::string json;
  std::string records;
};

double milliseconds_of(const std::function<void()>& work) {
  const auto before = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before)
      .count();
}

void expect_shown(const server::HttpResponse& response) {
  if (response.status != 200) throw InvalidInput("bench replay: " + *response.body);
}

nlohmann::ordered_json row_of(const char* what, std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1) + 0.5)];
  };
  return {{"what", what},
          {"times", times.size()},
          {"p50_ms", at(0.5)},
          {"p99_ms", at(0.99)},
          {"worst_ms", times.back()}};
}

nlohmann::ordered_json measure(const cases::CaseData& data,
                               const LongOperation& operation,
                               const BenchReplayArguments& arguments) {
  const records::Attempt attempt =
      server::make_attempt({data, operation.recording, {}, {}, "", "script", ""});
  server::ReplayDesk desk(data, procedures::built_in(),
                          [&](std::int64_t) { return std::optional(attempt); });
  const auto length = static_cast<std::int64_t>(operation.recording.tick_count());
  const auto show = [&](std::int64_t tick, std::int64_t to, std::int64_t every) {
    return milliseconds_of([&] { expect_shown(desk.states(1, {tick, to, every})); });
  };
  const double open_ms = show(0, 0, 1);
  Rng rng(1);
  std::vector<double> seeks;
  std::vector<double> stretches;
  for (int i = 0; i < arguments.seeks; ++i) {
    const auto tick = static_cast<std::int64_t>(rng.below(static_cast<std::uint64_t>(length)));
    seeks.push_back(show(tick, tick, 1));
    stretches.push_back(show(tick, tick + 1320, 33));
  }
  std::vector<double> worst;  // just before a keyframe, from far away
  for (std::int64_t tick = 9999; tick < length; tick += 100'000) {
    (void)show(0, 0, 1);
    worst.push_back(show(tick, tick, 1));
  }
  std::vector<double> pictures;
  for (const Tick shot : operation.shots) {
    pictures.push_back(
        milliseconds_of([&] { expect_shown(desk.picture(1, static_cast<std::int64_t>(shot))); }));
  }
  auto rows = nlohmann::ordered_json::array({row_of("any moment", seeks),
                                             row_of("before a keyframe", worst),
                                             row_of("1.3 s to play", stretches)});
  // The first of them takes the scan apart.
  const double first_picture_ms = pictures.empty() ? 0.0 : pictures.front();
  if (pictures.size() > 1) {
    rows.push_back(row_of("a picture", {pictures.begin() + 1, pictures.end()}));
  }
  return {{"case", data.pseudonym},
          {"case_simulated", data.provenance.simulated},
          {"procedure", operation.recording.procedure},
          {"ticks", length},
          {"recording_bytes", attempt.recording.size()},
          {"keyframes", operation.recording.keyframes.size()},
          {"open_ms", open_ms},
          {"first_picture_ms", first_picture_ms},
          {"rows", std::move(rows)}};
}

void print(const cases::CaseData& data, const nlohmann::ordered_json& f) {
  std::printf("replay of %.1f minutes on %s, %s: %.1f MB, %zu keyframes\n",
              f["ticks"].get<double>() / 60000.0, in_words(data).c_str(),
              f["procedure"].get<std::string>().c_str(), f["recording_bytes"].get<double>() / 1e6,
              f["keyframes"].get<std::size_t>());
  std::printf("opened in %.0f ms, the first picture in %.0f ms\n", f["open_ms"].get<double>(),
              f["first_picture_ms"].get<double>());
  std::printf("%-20s %7s %10s %10s %10s\n", "to show", "times", "p50 ms", "p99 ms", "worst ms");
  for (const auto& row : f["rows"]) {
    std::printf("%-20s %7zu %10.1f %10.1f %10.1f\n", row["what"].get<std::string>().c_str(),
                row["times"].get<std::size_t>(), row["p50_ms"].get<double>(),
                row["p99_ms"].get<double>(), row["worst_ms"].get<double>());
  }
}

/// For a page to look at: an attempt that has neither a score nor a log.
void store(const cases::CaseData& data,
           const LongOperation& operation,
           const std::string& records_file) {
  records::AttemptKeeper keeper(records_file);
  const records::KeptAttempt kept = keeper.save(server::make_attempt(
      {data, operation.recording, {}, {}, "long operation", "script", records::utc_now()}));
  if (!kept.problem.empty()) throw IoError(kept.problem);
  std::printf("stored as attempt %lld in %s\n", static_cast<long long>(kept.id),
              records_file.c_str());
}

void run(const BenchReplayArguments& arguments) {
  if (!(arguments.minutes >= 1.0 && arguments.minutes <= 120.0) || arguments.seeks < 1 ||
      arguments.seeks > 10'000) {
    throw UsageError("bench replay: give --minutes 1 to 120 and --seeks 1 to 10000");
  }
  const cases::CaseData data = load_case(arguments.case_folder);
  const procedure::Procedure& procedure = arguments.procedure.empty()
                                              ? *procedures::built_in().all().front()
                                              : find_procedure(arguments.procedure);
  const LongOperation operation =
      make_long_operation(data, procedure, static_cast<Tick>(arguments.minutes * 60'000.0));
  if (!arguments.records.empty()) store(data, operation, arguments.records);
  const nlohmann::ordered_json figures = measure(data, operation, arguments);
  print(data, figures);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, figures.dump(2) + "\n");
  }
}

}  // namespace

void add_bench_replay_command(CLI::App& bench) {
  auto arguments = std::make_shared<BenchReplayArguments>();
  CLI::App* command = bench.add_subcommand(
      "replay", "Time to show any moment of a long operation again, as a page asks for it");
  command->add_option("--case", arguments->case_folder, "Case to operate on")
      ->capture_default_str();
  command->add_option("--procedure", arguments->procedure, "Id of the procedure; the first");
  command->add_option("--minutes", arguments->minutes, "Length of the operation")
      ->capture_default_str();
  command->add_option("--seeks", arguments->seeks, "Moments, chosen by chance")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->add_option("--records", arguments->records, "Store the operation in this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
