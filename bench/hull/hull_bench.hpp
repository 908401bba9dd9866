// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Times hull engines on point sets: answers first, then seconds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/capped_run.hpp"
#include "bench/hull/engine.hpp"
#include "bench/hull/point_sets.hpp"

namespace carpus::bench {

/// One engine on one point set.
struct HullRow {
  std::string set;
  std::string engine;
  Origin origin{};
  std::size_t n = 0;
  std::size_t h = 0;  ///< hull vertices that this engine found
  std::size_t facets = 0;
  bool is_peer = false;
  bool ran = false;     ///< false: beyond its cost or the caps, "not run"
  bool agrees = false;  ///< same corners, facets and volume as the exact answer
  double seconds = 0;   ///< median of the rounds' medians
  double fastest_seconds = 0;
  int runs = 0;
  double discarded_share = 0;
};

struct HullBenchOptions {
  Caps caps;
  double budget_seconds = 0.4;  ///< an engine repeats until this is used up; see hull_bench.cpp
  int max_runs = 41;
};

/// Runs every engine on the set, each in a process of its own, in rounds by turns. The exact answer
/// is quickhull's, which the module's tests verify independently.
[[nodiscard]] std::vector<HullRow> measure_hulls(const PointSet& set,
                                                 const std::vector<HullEngine>& engines,
                                                 const HullBenchOptions& options);

}  // namespace carpus::bench
