// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <system_error>

#include "records/atomic_file.hpp"

namespace carpus::cli {

/// A file that can be made or replaced: said before the work whose figures it is to hold, which may
/// take an hour. Not for a file in a folder that the same command makes.
inline CLI::Validator output_file() {
  const auto refusal = [](const std::string& text) -> std::string {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path file(text);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (fs::is_directory(file, ignored)) return "'" + text + "' is a folder; give a file's name";
    if (!fs::is_directory(folder, ignored)) {
      return "there is no folder '" + folder.string() + "' for '" + text + "'; create it first";
    }
    if (!records::is_replaceable(file)) {
      return "'" + text + "' is a device or no plain file; give another name";
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
      return "in the folder '" + folder.string() + "' nothing may be written; choose another";
    }
    return {};
  };
  return {refusal, "FILE"};
}

}  // namespace carpus::cli
