// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/soft_tissue_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arthroscopy/make_map.hpp"
#include "case_io/case_folder.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "cases/make_hand_motion.hpp"
#include "cases/make_structures.hpp"
#include "cli/operation_files.hpp"
#include "cli/output_file.hpp"
#include "cli/section_picture.hpp"
#include "cli/section_report.hpp"
#include "cli/soft_tissue_report.hpp"
#include "cli/write_structures.hpp"
#include "reconstruct/skin_surface.hpp"
#include "reconstruct/stage_clock.hpp"
#include "records/atomic_file.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "soft_tissue/sectioning.hpp"
#include "soft_tissue/traction.hpp"

namespace carpus::cli {
namespace {

struct Arguments {
  std::string case_folder = kDefaultCase;
  bool check = false;
  bool traction = false;
  bool section = false;
  std::string json;
  std::string svg;
};

void print_pull(const cases::CaseData& data,
                const soft_tissue::SoftTissue& tissue,
                const soft_tissue::TractionOptions& options) {
  const soft_tissue::TractionResult r = soft_tissue::pull(data, tissue, options);
  std::printf("%5.0f N   x %.0f   %5.2f / %5.2f   %5.2f / %5.2f   %.2f N  ", options.force_n,
              options.stiffness_factor, options.radiocarpal_slack_mm, options.midcarpal_slack_mm,
              r.radiocarpal_mm, r.midcarpal_mm, r.unbalanced_n);
  for (std::size_t i = 0; i < std::min<std::size_t>(4, r.forces.size()); ++i) {
    std::printf(" %s %.0f", r.forces[i].id.c_str(), r.forces[i].newtons);
  }
  std::printf("\n");
}

/// Ours beside the published opening of awake volunteers [S66].
void print_traction(const cases::CaseData& data, const soft_tissue::SoftTissue& tissue) {
  constexpr double kRadiocarpalMm = 1.0;
  constexpr double kMidcarpalMm = 2.0;
  std::printf(
      "\ntraction, at rest; radiocarpal / midcarpal mm. Published, 98 N: 1.0 +- 1.0 / 2.0 +- 1.7\n"
      "  force   stiffn.  slack           opening       left over  carried by (N)\n");
  for (const double factor : {1.0, 2.0, 3.0}) {
    soft_tissue::TractionOptions options;
    options.stiffness_factor = factor;
    print_pull(data, tissue, options);
    options = soft_tissue::fit_slack(data, tissue, options, kRadiocarpalMm, kMidcarpalMm);
    for (const double force : {98.0, 69.0, 34.0}) {
      options.force_n = force;
      print_pull(data, tissue, options);
    }
  }
  std::printf("slack is fitted to the published means, not measured\n");
}

void print_section(const cases::CaseData& data,
                   const soft_tissue::SoftTissue& tissue,
                   const Arguments& a) {
  const auto& table = soft_tissue::SectioningTable::generic();
  const soft_tissue::SectioningResult result = soft_tissue::section(data, tissue, table);
  std::fputs(section_table(result, table).c_str(), stdout);
  if (!a.json.empty()) {
    records::write_file_atomically(
        a.json, section_json(result, table, data.pseudonym, data.provenance.simulated));
  }
  if (!a.svg.empty()) records::write_file_atomically(a.svg, section_picture(result, table));
}

/// Tendons, arteries and nerves that an older program did not know. Returns whether there were any.
bool add_structures(cases::CaseData& data, const Arguments& a) {
  const cases::AddedStructures added = cases::add_missing_structures(data);
  for (const std::string& problem : added.problems) {
    std::printf("problem: %s\n", problem.c_str());
  }
  if (added.names.empty()) return false;
  std::printf("%s, generated, not seen in the CT:\n",
              a.check ? "missing and not written" : "added to the case");
  for (const std::string& each : added.names) std::printf("  %s\n", each.c_str());
  return true;
}

/// Writes soft tissue, and structures that had to give way to it.
soft_tissue::SoftTissue make_anew(cases::CaseData& data,
                                  const Arguments& a,
                                  bool has_added,
                                  const Progress& progress) {
  const auto& table = soft_tissue::TissueTable::generic();
  if (a.check) return soft_tissue::make_soft_tissue(data, table, progress);
  const std::vector<cases::Structure> before = data.structures;
  soft_tissue::SoftTissue tissue =
      soft_tissue::make_soft_tissue_moving_structures(data, table, progress);
  if (has_added || data.structures != before) {
    write_structures(data, a.case_folder);
    std::printf(
        "tendons, arteries and nerves have changed: attempts recorded before are of the case as it "
        "was\n\n");
  }
  case_io::write_soft_tissue(tissue, data, a.case_folder);
  return tissue;
}

void run(const Arguments& a) {
  cases::CaseData data = case_io::read_case(a.case_folder);
  const bool has_added = add_structures(data, a);
  cases::ensure_hand_motion(data);
  reconstruct::StageClock clock;
  const soft_tissue::SoftTissue tissue =
      make_anew(data, a, has_added, [&](std::string_view stage, double) { clock.begin(stage); });
  clock.end();
  std::fputs(soft_tissue_table(tissue, data).c_str(), stdout);
  data.skin = reconstruct::trimmed_skin(data.skin, data.ct.geometry());
  const cases::ArthroscopicMap map = arthroscopy::make_map(data, tissue);
  std::fputs(portal_table(map, data).c_str(), stdout);
  std::fputs(yielding_table(data, map).c_str(), stdout);
  if (a.traction) print_traction(data, tissue);
  if (a.section) print_section(data, tissue, a);
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
      "soft-tissue",
      "Make ligaments, disc, cartilage and joint spaces of a case, and what it lacks of "
      "tendons, arteries and nerves (generated)");
  command->add_option("case", a->case_folder, "Case folder")->capture_default_str();
  command->add_flag("--check", a->check, "Print the figures, write nothing");
  command->add_flag("--traction", a->traction,
                    "Pull at the fingers: openings beside published ones");
  CLI::Option* section = command->add_flag(
      "--section", a->section, "Turn the hand with ligaments cut: ranges beside published ones");
  command->add_option("--json", a->json, "Write the figures of --section to this file")
      ->check(output_file())
      ->needs(section);
  command->add_option("--svg", a->svg, "Draw the angle against the moment of --section")
      ->check(output_file())
      ->needs(section);
  command->callback([a] { run(*a); });
}

}  // namespace carpus::cli
