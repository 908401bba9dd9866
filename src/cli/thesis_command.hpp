// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// `carpus thesis`: chapters 3 to 5 of the thesis [yaacoub2008] anew, in one report.
void add_thesis_command(CLI::App& app);

}  // namespace carpus::cli
