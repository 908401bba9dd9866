// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_segmentation_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "cli/seed_option.hpp"
#include "cli/segmentation_study.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

struct StudySegmentationArguments {
  std::size_t seeds = 8;
  std::uint64_t first_seed = 1;
  double voxel_mm = 0.5;
  std::string json;
  std::string picture;
};

void run(const StudySegmentationArguments& arguments) {
  SegmentationStudy study;
  study.voxel_mm = arguments.voxel_mm;
  for (std::size_t i = 0; i < arguments.seeds; ++i) {
    study.scans.push_back(study_scan(arguments.first_seed + i, arguments.voxel_mm));
    const StudiedScan& scan = study.scans.back();
    double worst = 1;
    for (const StudiedBone& bone : scan.bones) worst = bone.dice < worst ? bone.dice : worst;
    std::string conditions;
    for (const std::string& each : scan.conditions)
      conditions += (conditions.empty() ? "" : ", ") + each;
    std::fprintf(stderr, "seed %llu: worst Dice %.3f, misfit %.1f (%s) %s\n",
                 static_cast<unsigned long long>(scan.seed), worst, scan.naming_cost,
                 conditions.c_str(), scan.refused.c_str());
    // What there is of a long run is kept.
    if (!arguments.json.empty()) {
      records::write_file_atomically(arguments.json, segmentation_study_json(study));
    }
  }
  std::fputs(segmentation_study_text(study).c_str(), stdout);
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
  command->add_option("--voxel", arguments->voxel_mm, "Side of the voxels [mm]")
      ->check(CLI::Range(0.3, 1.0))
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write every figure to this file");
  command->add_option("--picture", arguments->picture, "Draw the figures into this file, as SVG");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
