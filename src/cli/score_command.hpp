// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus score`: the score of a recorded operation.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers the subcommand; its callback throws carpus::Error where it fails.
void add_score_command(CLI::App& app);

}  // namespace carpus::cli
