// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus attempts`: lists what is in the records and takes recordings out of them.
#pragma once

#include <string>
#include <vector>

#include "records/attempt.hpp"

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers the subcommand; its callback throws carpus::Error where it fails.
void add_attempts_command(CLI::App& app);

/// The list for people: one line an attempt.
[[nodiscard]] std::string attempts_table(const std::vector<records::AttemptSummary>& attempts);

}  // namespace carpus::cli
