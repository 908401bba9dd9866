// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace carpus::cli {

/// `carpus study segmentation`
void add_study_segmentation_command(CLI::App& study);

}  // namespace carpus::cli
