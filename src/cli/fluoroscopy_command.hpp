// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus fluoroscopy`.
#pragma once

#include <CLI/App.hpp>

namespace carpus::cli {

void add_fluoroscopy_command(CLI::App& app);

}  // namespace carpus::cli
