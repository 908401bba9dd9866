// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench tick`: how long one simulation tick takes, scene by scene, and what an exercise
// costs beside it.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers `tick` below `bench`; its callback throws carpus::Error where it fails.
void add_bench_tick_command(CLI::App& bench);

}  // namespace carpus::cli
