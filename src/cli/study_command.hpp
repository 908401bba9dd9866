// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus study`: what the trainer claims, tried on many seeds and cases; one subcommand a study.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

void add_study_command(CLI::App& app);

}  // namespace carpus::cli
