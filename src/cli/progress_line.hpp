// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How long work shows where it is.
#pragma once

#include <string_view>

namespace carpus::cli {

/// Shows progress on stderr, a core/progress.hpp reporter: on a terminal one line that is
/// overwritten, else one line for each new stage.
void show_progress(std::string_view stage, double fraction);

}  // namespace carpus::cli
