// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// `carpus mend`: what was painted on a case's labels as it will be, without making the case anew.
void add_mend_command(CLI::App& app);

}  // namespace carpus::cli
