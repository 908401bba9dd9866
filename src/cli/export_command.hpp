// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus export`: a case's bones and labels for other programs.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

void add_export_command(CLI::App& app);

}  // namespace carpus::cli
