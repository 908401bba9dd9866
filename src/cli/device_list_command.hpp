// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus device list`.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// Registers `list` below `device`; its callback throws carpus::Error where it fails.
void add_device_list_command(CLI::App& device);

}  // namespace carpus::cli
