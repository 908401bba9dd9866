// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/soft_tissue_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "case_io/case_folder.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "cases/make_hand_motion.hpp"
#include "cli/operation_files.hpp"
#include "cli/soft_tissue_report.hpp"
#include "reconstruct/stage_clock.hpp"
#include "soft_tissue/make_soft_tissue.hpp"

namespace carpus::cli {
namespace {

struct Arguments {
  std::string case_folder = kDefaultCase;
  bool check = false;
};

void run(const Arguments& a) {
  cases::CaseData data = case_io::read_case(a.case_folder);
  cases::ensure_hand_motion(data);
  reconstruct::StageClock clock;
  const auto tissue =
      soft_tissue::make_soft_tissue(data, soft_tissue::TissueTable::generic(),
                                    [&](std::string_view stage, double) { clock.begin(stage); });
  clock.end();
  if (!a.check) case_io::write_soft_tissue(tissue, data, a.case_folder);
  std::fputs(soft_tissue_table(tissue, data).c_str(), stdout);
  double whole = 0;
  for (const reconstruct::StageTime& stage : clock.stages()) {
    whole += stage.seconds;
    if (stage.name != "done") std::printf("%s %.2f s, ", stage.name.c_str(), stage.seconds);
  }
  std::printf("all %.2f s\n", whole);
}

}  // namespace

void add_soft_tissue_command(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "soft-tissue", "Make ligaments, disc, cartilage and joint spaces of a case (generated)");
  command->add_option("case", a->case_folder, "Case folder")->capture_default_str();
  command->add_flag("--check", a->check, "Print the figures, write nothing");
  command->callback([a] { run(*a); });
}

}  // namespace carpus::cli
