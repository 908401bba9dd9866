// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench collision`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace carpus::bench {

struct CollisionArguments {
  std::string table = "pair";
  std::filesystem::path json;
  std::filesystem::path plot;
  std::filesystem::path bones;
  double budget_seconds = 8;
  std::size_t pairs = 0;
  std::vector<std::string> engines;
  unsigned cap_seconds = 90;
  std::size_t cap_gib = 8;
};

/// @param arguments  must outlive the app's parsing.
void add_collision(CLI::App& app, CollisionArguments& arguments);

}  // namespace carpus::bench
