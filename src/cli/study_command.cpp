// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_command.hpp"

#include <CLI/CLI.hpp>

#include "cli/study_axes_command.hpp"
#include "cli/study_segmentation_command.hpp"
#include "cli/study_validity_command.hpp"
#include "cli/study_views_command.hpp"

namespace carpus::cli {

void add_study_command(CLI::App& app) {
  CLI::App* study =
      app.add_subcommand("study", "Try what the trainer claims on many seeds and cases, in silico");
  study->require_subcommand(1);
  add_study_views_command(*study);
  add_study_validity_command(*study);
  add_study_axes_command(*study);
  add_study_segmentation_command(*study);
}

}  // namespace carpus::cli
