// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// This program as a child that works aside, with its progress followed, and ended when asked.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.hpp"

namespace carpus::cli {

struct ProgramEnd {
  bool is_well = false;
  bool was_stopped = false;
  std::string complaint;  ///< its last line that is no progress and no warning
};

/// "[ 12 %] surfaces" as show_progress writes it. @return whether the line is one
bool follow_progress(std::string_view line, const Progress& progress);

/// Runs a program to its end, with little claim on the processor, without input and with no
/// descriptor of ours. Ended (SIGTERM, and after a second SIGKILL) when `stop` is set, or when it
/// takes longer than `longest`; it does not outlive this process.
/// @throws IoError  it cannot be started.
[[nodiscard]] ProgramEnd run_watched(const std::filesystem::path& program,
                                     const std::vector<std::string>& arguments,
                                     const Progress& progress,
                                     const std::atomic<bool>& stop,
                                     std::chrono::seconds longest);

}  // namespace carpus::cli
