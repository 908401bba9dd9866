// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/score_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct ScoreArguments {
  std::string recording;
  std::string case_folder = kDefaultCase;
  std::string json;
};

void run(const ScoreArguments& arguments) {
  const simulation::Recording recording = load_recording(arguments.recording);
  const cases::CaseData data = load_case(arguments.case_folder);
  const simulation::Replay replay = replay_on_its_case(data, recording);
  if (!replay.hash_matches) {
    throw InvalidInput(
        "the recording does not reproduce its state hash, so its score would not be "
        "that of the operation; it was made by " +
        recording.program_version);
  }
  const procedure::ScoreReport report =
      find_procedure(recording.procedure).score(data, replay.record);
  std::printf("operation on %s\n", in_words(data).c_str());
  if (!replay.last.finished) std::printf("The operation was not finished.\n");
  std::fputs(score_table(report).c_str(), stdout);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, score_file(data, report));
  }
}

}  // namespace

void add_score_command(CLI::App& app) {
  auto arguments = std::make_shared<ScoreArguments>();
  CLI::App* command = app.add_subcommand("score", "Score a recorded operation");
  command->add_option("recording", arguments->recording, "Recording of an operation")->required();
  command->add_option("--case", arguments->case_folder, "Case that it was made on")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the report to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
