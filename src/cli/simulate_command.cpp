// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "cli/seed_option.hpp"
#include "core/error.hpp"
#include "core/hexadecimal.hpp"
#include "core/version.hpp"
#include "procedures/built_in.hpp"
#include "protocol/types.hpp"
#include "records/atomic_file.hpp"
#include "records/attempt_keeper.hpp"
#include "records/utc_time.hpp"
#include "server/exercise.hpp"
#include "session/body_names.hpp"
#include "session/event_text.hpp"
#include "trainee/attempt.hpp"

namespace carpus::cli {
namespace {

struct SimulateArguments {
  std::string case_folder = kDefaultCase;
  std::string procedure;
  std::string trainee = "expert";
  std::uint64_t seed = 1;
  std::string out;
  std::string records;
  std::string json;
};

/// "list": what can be operated on this program, one a line, and nothing else.
void list_procedures() {
  for (const procedure::Procedure* each : procedures::built_in().all()) {
    std::printf("%-28s %s\n", each->id.c_str(), each->title.c_str());
  }
}

void store(const cases::CaseData& data,
           const procedure::Procedure& procedure,
           const trainee::Attempt& attempt,
           const SimulateArguments& arguments,
           const std::string& started_at) {
  std::vector<protocol::LoggedEvent> log;
  const session::BodyNames bodies(data);
  for (const simulation::Event& event : attempt.events) {
    log.push_back(session::describe(event, procedure, bodies));
  }
  std::optional<procedure::ScoreReport> score;
  if (attempt.last.finished) score = attempt.score;
  const std::string name = "scripted " + arguments.trainee + " " + std::to_string(arguments.seed);
  const records::Attempt record = server::make_attempt(
      {data, attempt.recording, log, std::move(score), name, "script", started_at});
  records::AttemptKeeper keeper(arguments.records);
  const records::KeptAttempt kept = keeper.save(record);
  if (!kept.problem.empty()) throw IoError(kept.problem);
  std::printf("stored as attempt %lld in %s\n", static_cast<long long>(kept.id),
              arguments.records.c_str());
}

void run(const SimulateArguments& arguments) {
  if (arguments.procedure == "list") return list_procedures();
  const procedure::Procedure& procedure = arguments.procedure.empty()
                                              ? *procedures::built_in().all().front()
                                              : find_procedure(arguments.procedure);
  const cases::CaseData data = load_case(arguments.case_folder);
  const std::string started_at = records::utc_now();
  const auto before = std::chrono::steady_clock::now();
  const trainee::Attempt attempt =
      trainee::operate(data, procedure, trainee::skill_of(arguments.trainee).value(),
                       arguments.seed, kProgramVersion);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  std::printf("%s by scripted %s, seed %llu, on %s: %.3f s simulated in %.2f s, state hash %s\n",
              procedure.id.c_str(), arguments.trainee.c_str(),
              static_cast<unsigned long long>(arguments.seed), in_words(data).c_str(),
              static_cast<double>(attempt.recording.tick_count()) / 1000.0, seconds,
              hexadecimal(attempt.recording.end_hash).c_str());
  std::fputs(score_table(attempt.score).c_str(), stdout);
  if (!arguments.out.empty()) {
    records::write_file_atomically(arguments.out, simulation::encode(attempt.recording));
  }
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, score_file(data, attempt.score));
  }
  if (!arguments.records.empty()) store(data, procedure, attempt, arguments, started_at);
  if (!attempt.last.finished) {
    throw InvalidInput("the scripted trainee did not finish the operation on this case");
  }
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "Let a scripted trainee operate, and score the operation");
  command->add_option("--case", arguments->case_folder, "Case folder to operate on")
      ->capture_default_str();
  command->add_option("--procedure", arguments->procedure,
                      "Which operation, 'list' for all; the first of them without this option");
  command->add_option("--trainee", arguments->trainee, "Who operates")
      ->check(CLI::IsMember({"expert", "middle", "novice"}))
      ->capture_default_str();
  add_seed_option(*command, arguments->seed, "Of the trainee's errors and tremor");
  command->add_option("--out", arguments->out, "Write the recording to this file")
      ->check(output_file());
  command->add_option("--records", arguments->records, "Store the attempt in this file")
      ->check(output_file());
  command->add_option("--json", arguments->json, "Write the score report to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
