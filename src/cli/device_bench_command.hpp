// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus device bench`: both drives of our arm and the thesis's arm, measured without an arm.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers `bench` below `device`; its callback throws carpus::Error where it fails.
void add_device_bench_command(CLI::App& device);

}  // namespace carpus::cli
