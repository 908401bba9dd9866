// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench hull`.
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <filesystem>
#include <string>

namespace carpus::bench {

struct HullArguments {
  std::string table = "bones";
  std::filesystem::path json;
  std::filesystem::path plot;
  std::filesystem::path bones;
  std::size_t min_points = 10'000;
  std::size_t max_points = 100'000;
  double budget_seconds = 0.4;
  unsigned cap_seconds = 60;
  std::size_t cap_gib = 8;
};

/// @param arguments  must outlive the app's parsing.
void add_hull(CLI::App& app, HullArguments& arguments);

}  // namespace carpus::bench
