// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/replay_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/motion_table.hpp"
#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "core/hexadecimal.hpp"
#include "core/version.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct ReplayArguments {
  std::string recording;
  std::string case_folder = kDefaultCase;
  std::string json;
  std::string motion;
  unsigned every_ms = 20;
};

void run(const ReplayArguments& arguments) {
  const simulation::Recording recording = load_recording(arguments.recording);
  const cases::CaseData data = load_case(arguments.case_folder);
  const auto before = std::chrono::steady_clock::now();
  MotionTable motion(arguments.every_ms);
  const simulation::Replay replay = replay_on_its_case(
      data, recording,
      arguments.motion.empty() ? std::function<void(const simulation::Snapshot&)>()
                               : [&](const simulation::Snapshot& now) { motion.see(now); });
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  const std::string recorded = hexadecimal(recording.end_hash);
  const std::string replayed = hexadecimal(replay.last.state_hash);
  const double simulated_s = static_cast<double>(recording.tick_count()) / 1000.0;
  std::printf("operation on %s\n", in_words(data).c_str());
  std::printf("recorded  %s  by %s, %.3f s simulated\n", recorded.c_str(),
              recording.program_version.c_str(), simulated_s);
  std::printf("replayed  %s  in %.3f s\n", replayed.c_str(), seconds);
  std::printf("%s\n", replay.hash_matches ? "the hashes match" : "THE HASHES DIFFER");
  if (!arguments.json.empty()) {
    const nlohmann::ordered_json json{{"case", data.pseudonym},
                                      {"case_simulated", data.provenance.simulated},
                                      {"procedure", recording.procedure},
                                      {"recorded_hash", recorded},
                                      {"replayed_hash", replayed},
                                      {"hash_matches", replay.hash_matches},
                                      {"recorded_by", recording.program_version},
                                      {"ticks", recording.tick_count()},
                                      {"simulated_s", simulated_s},
                                      {"replay_s", seconds}};
    records::write_file_atomically(arguments.json, json.dump(2) + "\n");
  }
  if (!arguments.motion.empty()) {
    records::write_file_atomically(arguments.motion, motion.text());
  }
  if (!replay.hash_matches) {
    throw InvalidInput("the recording does not reproduce its state hash: it was made by " +
                       recording.program_version + ", this is " + kProgramVersion +
                       "; replay it with the program that made it");
  }
}

}  // namespace

void add_replay_command(CLI::App& app) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command =
      app.add_subcommand("replay", "Step through a recording and compare the state hash");
  command->add_option("recording", arguments->recording, "Recording of an operation")->required();
  command->add_option("--case", arguments->case_folder, "Case that it was made on")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  CLI::Option* motion = command
                            ->add_option("--motion", arguments->motion,
                                         "Write how the instruments moved to this table (.csv)")
                            ->check(output_file());
  command->add_option("--every", arguments->every_ms, "Milliseconds between two lines of the table")
      ->check(CLI::Range(1U, 60000U))
      ->needs(motion)
      ->capture_default_str();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
