// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus kinematics`: how a case's bones move with the hand.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers the subcommand; its callback throws carpus::Error where it fails.
void add_kinematics_command(CLI::App& app);

}  // namespace carpus::cli
