// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus segment`: the watershed by markers of the thesis's §3.2, for itself.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

void add_segment_command(CLI::App& app);

}  // namespace carpus::cli
