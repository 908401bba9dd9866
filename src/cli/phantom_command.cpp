// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/phantom_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "case_io/atomic_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/seed_option.hpp"
#include "core/error.hpp"
#include "phantom/phantom.hpp"
#include "phantom/write_phantom.hpp"

namespace carpus::cli {
namespace {

struct PhantomArguments {
  std::string out;
  std::uint64_t seed = 1;
  std::string fracture = "waist";
  std::string side = "left";
  double scale = 1.0;
  std::string format = "dicom";
  std::vector<std::string> conditions;
  double severity = 0.5;
  std::vector<int> filled_voxels;
  bool force = false;
};

void run(const PhantomArguments& arguments) {
  phantom::PhantomOptions options;
  options.seed = arguments.seed;
  options.scale = arguments.scale;
  options.fracture = phantom::fracture_of(arguments.fracture).value();  // CLI11 checked the name
  options.side = side_of(arguments.side).value();
  for (const std::string& name : arguments.conditions) {
    phantom::apply(phantom::condition_of(name).value(), arguments.severity, options.scan);
  }
  if (!arguments.filled_voxels.empty()) {
    options.filled_voxels = {arguments.filled_voxels[0], arguments.filled_voxels[1],
                             arguments.filled_voxels[2]};
  }
  const auto format =
      arguments.format == "dicom" ? phantom::CtFormat::Dicom : phantom::CtFormat::Nifti;
  const auto overwrite = arguments.force ? case_io::Overwrite::Replace : case_io::Overwrite::Refuse;
  // Refuses a folder that is in the way before the work, not after it.
  { const case_io::AtomicFolder probe(arguments.out, overwrite); }
  const phantom::Phantom made = phantom::make_phantom(options, show_progress);
  phantom::write_phantom(made, arguments.out, format, overwrite, show_progress);
  const auto& size = made.ct.geometry().size;
  std::printf("simulated CT of a %s wrist, fracture %s, %d x %d x %d voxels: %s\n",
              arguments.side.c_str(), arguments.fracture.c_str(), size[0], size[1], size[2],
              arguments.out.c_str());
}

}  // namespace

void add_phantom_command(CLI::App& app) {
  auto arguments = std::make_shared<PhantomArguments>();
  CLI::App* command = app.add_subcommand(
      "phantom", "Make the demo patient: a simulated CT of the parametric wrist with its truth");
  command->add_option("--out", arguments->out, "Folder to make")->required();
  add_seed_option(*command, arguments->seed, "Of noise, texture and pose");
  std::vector<std::string> kinds;
  for (const phantom::FractureKind kind : phantom::kAllFractureKinds) {
    kinds.emplace_back(phantom::name_of(kind));
  }
  command->add_option("--fracture", arguments->fracture, "Of the scaphoid")
      ->check(CLI::IsMember(kinds))
      ->capture_default_str();
  command->add_option("--side", arguments->side, "Side of the body")
      ->check(CLI::IsMember({"left", "right"}))
      ->capture_default_str();
  command->add_option("--scale", arguments->scale, "Size of the wrist; adults are 0.85 to 1.15")
      ->check(CLI::Range(0.7, 1.4))
      ->capture_default_str();
  command->add_option("--format", arguments->format, "Of the CT")
      ->check(CLI::IsMember({"dicom", "nifti"}))
      ->capture_default_str();
  std::vector<std::string> conditions;
  for (const phantom::Condition condition : phantom::kAllConditions) {
    conditions.emplace_back(phantom::name_of(condition));
  }
  command
      ->add_option("--with", arguments->conditions,
                   "What scanner and patient do otherwise; several may be given")
      ->check(CLI::IsMember(conditions));
  command->add_option("--severity", arguments->severity, "Of all that --with names")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--filled-voxels", arguments->filled_voxels,
                   "Voxels along x, y and z of a scan that the bones fill to its edges, to measure "
                   "what large scans cost")
      ->expected(3)
      ->check(CLI::Range(16, 1024));
  command->add_flag("--force", arguments->force, "Replace the folder where it is there already");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
