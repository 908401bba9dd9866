// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// `carpus study axes`: the scaphoid's lines and lengths, and what a screw along each scores.
void add_study_axes_command(CLI::App& study);

}  // namespace carpus::cli
