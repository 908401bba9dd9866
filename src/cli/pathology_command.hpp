// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus pathology`: what is wrong in a case's joints when they are examined.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers the subcommand; its callback throws carpus::Error where it fails.
void add_pathology_command(CLI::App& app);

}  // namespace carpus::cli
