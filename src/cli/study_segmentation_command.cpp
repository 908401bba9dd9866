// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_segmentation_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "cli/output_file.hpp"
#include "cli/seed_option.hpp"
#include "cli/segmentation_study.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct StudySegmentationArguments {
  std::size_t seeds = 8;
  std::uint64_t first_seed = 1;
  double voxel_mm = 0;  ///< 0: the seed's own
  std::string rows;
  std::string json;
  std::string picture;
};

void say(const StudiedScan& scan) {
  double worst = 1;
  for (const StudiedBone& bone : scan.bones) worst = std::min(worst, bone.dice);
  std::string conditions;
  for (const std::string& each : scan.conditions) {
    conditions += (conditions.empty() ? "" : ", ") + each;
  }
  std::fprintf(stderr, "seed %llu: worst Dice %.3f, misfit %.1f (%s) %s\n",
               static_cast<unsigned long long>(scan.seed), worst, scan.naming_cost,
               conditions.c_str(), scan.refused.c_str());
}

/// What an earlier run left; a half line at its end is cut off.
SegmentationStudy begun(const StudySegmentationArguments& arguments) {
  SegmentationStudy study;
  if (arguments.rows.empty() || !std::filesystem::exists(arguments.rows)) return study;
  std::ifstream file(arguments.rows);
  std::ostringstream text;
  text << file.rdbuf();
  study = study_of_rows(text.str(), arguments.rows);
  std::string whole;
  for (const StudiedScan& scan : study.scans) whole += row_of(scan);
  if (whole != text.str()) records::write_file_atomically(arguments.rows, whole);
  return study;
}

void run(const StudySegmentationArguments& arguments) {
  SegmentationStudy study = begun(arguments);
  for (std::size_t i = 0; i < arguments.seeds; ++i) {
    const std::uint64_t seed = arguments.first_seed + i;
    const auto has_seed = [&](const StudiedScan& scan) { return scan.seed == seed; };
    if (std::any_of(study.scans.begin(), study.scans.end(), has_seed)) continue;
    study.scans.push_back(
        study_scan(seed, arguments.voxel_mm > 0 ? arguments.voxel_mm : study_voxel_mm(seed)));
    say(study.scans.back());
    if (!arguments.rows.empty()) {
      std::ofstream file(arguments.rows, std::ios::app);
      file << row_of(study.scans.back()) << std::flush;
      if (!file) throw IoError("cannot write " + arguments.rows);
    }
  }
  std::fputs(segmentation_study_text(study).c_str(), stdout);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, segmentation_study_json(study));
  }
  if (!arguments.picture.empty()) {
    records::write_file_atomically(arguments.picture, segmentation_study_picture(study));
  }
}

}  // namespace

void add_study_segmentation_command(CLI::App& study) {
  auto arguments = std::make_shared<StudySegmentationArguments>();
  CLI::App* command = study.add_subcommand(
      "segmentation", "How well scans of growing difficulty are segmented, and what is told of it");
  command->add_option("--seeds", arguments->seeds, "Scans to simulate")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_seed_option(*command, arguments->first_seed, "Of the first scan; the next has the next");
  command
      ->add_option("--voxel", arguments->voxel_mm,
                   "Side of the voxels [mm]; the seed's own, from 0.4 to 0.7, if not given")
      ->check(CLI::Range(0.3, 1.0));
  command
      ->add_option("--rows", arguments->rows,
                   "Append each scan to this file as it is done; what it holds is not made again")
      ->check(output_file());
  command->add_option("--json", arguments->json, "Write every figure to this file")
      ->check(output_file());
  command->add_option("--picture", arguments->picture, "Draw the figures into this file, as SVG")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
