// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/kinematics_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "case_io/case_folder.hpp"
#include "cases/make_hand_motion.hpp"
#include "cli/kinematics_report.hpp"
#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct KinematicsArguments {
  std::string case_folder = kDefaultCase;
  std::string reference;
  std::string json;
  bool remake = false;
};

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw IoError(file + ": is not there or cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void run(const KinematicsArguments& arguments) {
  cases::CaseData data = case_io::read_case(arguments.case_folder);
  if (arguments.remake || data.hand_motion.is_empty()) {
    const auto start = std::chrono::steady_clock::now();
    data.hand_motion = cases::make_hand_motion(data);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::fprintf(stderr, "table of hand motion made in %.2f s\n", took.count());
  }
  const std::vector<Coupling> couplings = couplings_of(data);
  std::printf("hand motion of %s\n", in_words(data).c_str());
  std::fputs(kinematics_table(data, couplings).c_str(), stdout);
  MeasuredComparison comparison;
  if (!arguments.reference.empty()) {
    comparison = compare_with_measured(data, text_of(arguments.reference));
    std::fputs(comparison_table(comparison).c_str(), stdout);
  }
  if (!arguments.json.empty()) {
    records::write_file_atomically(
        arguments.json,
        kinematics_json(data, couplings, arguments.reference.empty() ? nullptr : &comparison));
  }
}

}  // namespace

void add_kinematics_command(CLI::App& app) {
  auto arguments = std::make_shared<KinematicsArguments>();
  CLI::App* command =
      app.add_subcommand("kinematics", "Show how a case's bones move with the hand");
  command->add_option("case", arguments->case_folder, "Case folder")->capture_default_str();
  command->add_option(
      "--reference", arguments->reference,
      "Compare with this file of measured motions, whose first position is the scan");
  command->add_flag("--remake", arguments->remake, "Make the table anew, not to be stored");
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
