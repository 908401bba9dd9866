// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus study views`: which C-arm views reveal a screw that is out of the scaphoid.
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

void add_study_views_command(CLI::App& study);

}  // namespace carpus::cli
