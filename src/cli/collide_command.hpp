// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus collide`: do two hulls meet, how far apart or how deep, and when on a straight course?
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers the subcommand; its callback throws carpus::Error where it fails.
void add_collide_command(CLI::App& app);

}  // namespace carpus::cli
