// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench replay`: how long any second of a long operation takes to be shown again.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers `replay` below `bench`; its callback throws carpus::Error where it fails.
void add_bench_replay_command(CLI::App& bench);

}  // namespace carpus::cli
