// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/simulated_scan.hpp"

#include <algorithm>
#include <cctype>

#include "case_io/read_volume.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

bool says_simulated(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.find("simulated") != std::string::npos;
}

}  // namespace

bool is_simulated_scan(const fs::path& input, const std::string& series_uid) {
  const fs::path folder = fs::is_directory(input) ? input : input.parent_path();
  for (const fs::path& place : {folder, folder / ".."}) {
    if (fs::exists(place / "truth.json")) return true;
  }
  return says_simulated(case_io::read_description(input, series_uid));
}

}  // namespace carpus::cli
