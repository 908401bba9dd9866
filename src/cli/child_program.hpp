// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Another program, or this one anew, as one step of longer work.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carpus::cli {

/// Where this program lies; its companions (carpus-bench) lie beside it.
[[nodiscard]] std::filesystem::path own_program();

/// The first of these names that is found on the PATH and may be run; empty where none is.
[[nodiscard]] std::filesystem::path find_on_path(const std::vector<std::string>& names);

/// Runs a program to its end, without input, with all that it says in `log`.
/// @throws IoError where it cannot be started or fails, with the last lines of what it said.
void run_program(const std::filesystem::path& program,
                 const std::vector<std::string>& arguments,
                 const std::filesystem::path& log);

}  // namespace carpus::cli
