// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// `carpus study validity`: whether the score separates scripted trainees, in silico.
void add_study_validity_command(CLI::App& study);

}  // namespace carpus::cli
