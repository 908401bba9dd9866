// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/hull_bench.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/stopwatch.hpp"
#include "core/error.hpp"

namespace carpus::bench {
namespace {

/// Volumes of the same corners differ by the rounding of the sum only.
constexpr double kVolumeRounding = 1e-9;

struct Timed {
  HullRun run;
  double median_seconds = 0;
  double fastest_seconds = 0;
  int runs = 0;
};

Timed repeat(const HullEngine& engine,
             std::span<const Vec3> points,
             const HullBenchOptions& options) {
  Timed timed;
  std::vector<double> seconds;
  const Stopwatch watch;
  do {
    timed.run = engine.run(points);
    seconds.push_back(timed.run.seconds);
  } while (watch.seconds() < options.budget_seconds &&
           static_cast<int>(seconds.size()) < options.max_runs);
  std::sort(seconds.begin(), seconds.end());
  timed.median_seconds = seconds[seconds.size() / 2];
  timed.fastest_seconds = seconds.front();
  timed.runs = static_cast<int>(seconds.size());
  return timed;
}

bool is_same(const HullRun& a, const HullRun& b) {
  return a.ok && b.ok && a.vertices == b.vertices && a.facets == b.facets &&
         std::abs(a.volume_mm3 - b.volume_mm3) <= kVolumeRounding * std::abs(b.volume_mm3);
}

}  // namespace

std::vector<HullRow> measure_hulls(const PointSet& set,
                                   const std::vector<HullEngine>& engines,
                                   const HullBenchOptions& options) {
  std::vector<std::optional<Timed>> results;
  const HullRun* exact = nullptr;
  for (const HullEngine& engine : engines) {
    const bool too_large = engine.max_points != 0 && set.points.size() > engine.max_points;
    results.push_back(too_large ? std::nullopt : run_capped<Timed>(options.caps, [&] {
      return repeat(engine, set.points, options);
    }));
  }
  for (std::size_t i = 0; i < engines.size(); ++i) {
    if (engines[i].name == "quickhull" && results[i]) exact = &results[i]->run;
  }
  std::vector<HullRow> rows;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    HullRow row;
    row.set = set.name;
    row.engine = engines[i].name;
    row.n = set.points.size();
    row.is_peer = engines[i].is_peer;
    if (const auto& timed = results[i]; timed && timed->run.ok) {
      row.ran = true;
      row.h = timed->run.vertices;
      row.facets = timed->run.facets;
      row.agrees = exact != nullptr && is_same(timed->run, *exact);
      row.seconds = timed->median_seconds;
      row.fastest_seconds = timed->fastest_seconds;
      row.runs = timed->runs;
      row.discarded_share = timed->run.points_discarded / static_cast<double>(row.n);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace carpus::bench
