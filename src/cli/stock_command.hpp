// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// `carpus stock`: makes the stock of practice cases.
void add_stock_command(CLI::App& app);

}  // namespace carpus::cli
