// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_views_command.hpp"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "cli/seed_option.hpp"
#include "cli/study_views_report.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct StudyViewsArguments {
  std::vector<std::string> cases{kDefaultCase};
  std::size_t seeds = 60;
  std::uint64_t first_seed = 1;
  std::string json;
  std::string picture;
};

void run(const StudyViewsArguments& arguments) {
  ViewsStudy study;
  study.first_seed = arguments.first_seed;
  study.seeds = arguments.seeds;
  for (std::size_t i = 0; i < arguments.cases.size(); ++i) {
    const cases::CaseData data = load_case(arguments.cases[i]);
    std::fprintf(stderr, "%zu screws in %s\n", arguments.seeds, in_words(data).c_str());
    study.simulated.push_back(data.provenance.simulated);
    study.cases.push_back(view_trainer::study_case(data, i, arguments.first_seed, arguments.seeds));
  }
  std::fputs(views_study_text(study).c_str(), stdout);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, views_study_json(study));
  }
  if (!arguments.picture.empty()) {
    records::write_file_atomically(arguments.picture, views_study_picture(study));
  }
}

}  // namespace

void add_study_views_command(CLI::App& study) {
  auto arguments = std::make_shared<StudyViewsArguments>();
  CLI::App* command =
      study.add_subcommand("views", "Which C-arm views reveal a screw that is out of the scaphoid");
  command->add_option("--cases", arguments->cases, "Case folders")->capture_default_str();
  command->add_option("--seeds", arguments->seeds, "Screws placed in each case")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_seed_option(*command, arguments->first_seed, "Of the first screw; the next has the next");
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->add_option("--picture", arguments->picture, "Draw the figures into this file, as SVG")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
