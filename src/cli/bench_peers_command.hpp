// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Adds the benchmarks against other libraries to `bench`. They live in carpus-bench, a program
/// beside this one, because nothing that is installed links those libraries.
void add_bench_peers_command(CLI::App& bench);

}  // namespace carpus::cli
