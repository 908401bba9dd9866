// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of many timed queries of one engine, and how they become rows.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/capped_run.hpp"
#include "bench/collision/engine.hpp"
#include "bench/collision/poses.hpp"
#include "bench/collision/timing.hpp"

namespace carpus::bench {

/// One row of any table.
struct CollisionRow {
  std::string pose_case;
  std::string query;  ///< boolean, distance, depth, tick_boolean, tick_distance
  std::string engine;
  bool is_peer = false;
  double facets = 0;  ///< of one body, in the mean
  bool ran = false;
  Timing timing;
  bool agrees = false;
  std::size_t original_vertices = 0;  ///< table 5.1: of the surface, not of its hull
  std::size_t original_facets = 0;    ///< table 5.1: likewise; 0: not known
  std::size_t hull_vertices = 0;      ///< table 5.1
  double thesis_seconds = 0;          ///< table 5.1: as printed; 0 where it has none
};

/// Bodies of one pair with its poses.
struct PairScript {
  const convex::ConvexBody* first = nullptr;
  const convex::ConvexBody* second = nullptr;
  PoseScript poses;
};

/// Over single queries, which take less than what else the machine does in between; every engine
/// near the fastest finishes all.
inline constexpr int kQueryPasses = 10;
/// Over ticks.
inline constexpr int kPasses = 3;

struct BenchOptions {
  Caps caps{std::size_t{8} << 30U, 60};
  double budget_seconds = 20;        ///< an engine on one case; what does not fit is not asked
  std::size_t pairs = 0;             ///< how many pairs of bones; 0: all near ones
  std::size_t poses = 100;           ///< a pair and case
  std::vector<std::string> engines;  ///< only these; empty: all

  [[nodiscard]] bool wants(const std::string& engine) const {
    return engines.empty() || std::find(engines.begin(), engines.end(), engine) != engines.end();
  }
};

/// Asks meets() for every pose; `cold` forgets before each.
[[nodiscard]] CollisionRow measure_verdicts(const PairEngine& engine,
                                            const std::string& pose_case,
                                            const std::vector<PairScript>& scripts,
                                            bool cold,
                                            const BenchOptions& options);

}  // namespace carpus::bench
