// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// `carpus bench imaging`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>

namespace carpus::bench {

struct ImagingArguments {
  std::filesystem::path json;
  bool quick = false;
};

/// @param arguments  must outlive the app's parsing.
void add_imaging(CLI::App& app, ImagingArguments& arguments);

}  // namespace carpus::bench
