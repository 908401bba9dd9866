// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Hull rows as JSON.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/hull/hull_bench.hpp"
#include "bench/hull/thesis_tables.hpp"

namespace carpus::bench {

struct HullReport {
  std::string table;
  std::string bones;                  ///< what was measured
  std::span<const ThesisRow> thesis;  ///< to stand beside; empty for our own tables
  std::vector<HullRow> rows;
};

/// docs/json.md, hull benchmark.
[[nodiscard]] std::string json_of(const HullReport& report);

}  // namespace carpus::bench
