// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench fluoroscopy`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>

namespace carpus::bench {

struct FluoroscopyArguments {
  std::filesystem::path case_folder = "cases/demo";
  std::filesystem::path json;
  std::filesystem::path pictures;
  double flexion_deg = 45.0;
};

/// @param arguments  must outlive the app's parsing.
void add_fluoroscopy(CLI::App& app, FluoroscopyArguments& arguments);

}  // namespace carpus::bench
