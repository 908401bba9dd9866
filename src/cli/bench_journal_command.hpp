// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench journal`: what it costs to have an exercise on disk as it happens.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers `journal` below `bench`; its callback throws carpus::Error where it fails.
void add_bench_journal_command(CLI::App& bench);

}  // namespace carpus::cli
