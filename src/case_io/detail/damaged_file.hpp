// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is said of a file of a case folder that nothing but the CT brings back.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"

namespace carpus::case_io {

inline constexpr const char* kRestore = "; restore it or make the case again from its CT";

[[nodiscard]] inline IoError damaged_file(const std::filesystem::path& file,
                                          const nlohmann::ordered_json::exception& error) {
  return IoError(file.string() + ": is damaged (" + error.what() + ")" + kRestore);
}

[[nodiscard]] inline IoError damaged_file(const std::filesystem::path& file, const IoError& error) {
  return IoError(file.string() + ": " + error.what() + kRestore);
}

}  // namespace carpus::case_io
