// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus device calibrate`.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers `calibrate` below `device`; its callback throws carpus::Error where it fails.
void add_device_calibrate_command(CLI::App& device);

}  // namespace carpus::cli
