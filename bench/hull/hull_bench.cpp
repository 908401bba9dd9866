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

/// Engines take turns, so that what else the machine does slows all of them alike.
constexpr int kRounds = 5;
/// An engine that needs less than this for one run gets three rounds, whatever the budget says.
constexpr double kPatienceSeconds = 5;

struct Timed {
  HullRun run;
  double median_seconds = 0;
  double fastest_seconds = 0;
  double spent_seconds = 0;
  int runs = 0;
};

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Timed repeat(const HullEngine& engine,
             std::span<const Vec3> points,
             double budget_seconds,
             int max_runs) {
  Timed timed;
  std::vector<double> seconds;
  const Stopwatch watch;
  do {
    timed.run = engine.run(points);
    seconds.push_back(timed.run.seconds);
  } while (watch.seconds() < budget_seconds && static_cast<int>(seconds.size()) < max_runs);
  timed.median_seconds = median_of(seconds);
  timed.fastest_seconds = *std::min_element(seconds.begin(), seconds.end());
  timed.spent_seconds = watch.seconds();
  timed.runs = static_cast<int>(seconds.size());
  return timed;
}

/// The rounds of one engine on one set.
class Rounds {
 public:
  /// Runs the next round, if there is time for one.
  void go_on(const HullEngine& engine,
             std::span<const Vec3> points,
             const HullBenchOptions& options) {
    const bool is_due = medians_.empty() ? !has_failed_
                                         : all_.spent_seconds < options.budget_seconds ||
                                               (medians_.size() < 3 && options.budget_seconds > 0 &&
                                                all_.fastest_seconds < kPatienceSeconds);
    if (!is_due || has_failed_ || all_.runs >= options.max_runs) return;
    const std::optional<Timed> timed = run_capped<Timed>(options.caps, [&] {
      return repeat(engine, points, options.budget_seconds / kRounds, options.max_runs - all_.runs);
    });
    has_failed_ = !timed || !timed->run.ok;
    if (has_failed_) return;
    medians_.push_back(timed->median_seconds);
    all_.fastest_seconds = all_.runs == 0 ? timed->fastest_seconds
                                          : std::min(all_.fastest_seconds, timed->fastest_seconds);
    all_.run = timed->run;
    all_.spent_seconds += timed->spent_seconds;
    all_.runs += timed->runs;
  }

  /// The median is that of the rounds' medians. Nothing where a round failed or none was run.
  [[nodiscard]] std::optional<Timed> result() const {
    if (has_failed_ || medians_.empty()) return std::nullopt;
    Timed timed = all_;
    timed.median_seconds = median_of(medians_);
    return timed;
  }

 private:
  Timed all_;
  std::vector<double> medians_;
  bool has_failed_ = false;
};

bool is_same(const HullRun& a, const HullRun& b) {
  return a.ok && b.ok && a.vertices == b.vertices && a.facets == b.facets &&
         std::abs(a.volume_mm3 - b.volume_mm3) <= kVolumeRounding * std::abs(b.volume_mm3);
}

}  // namespace

std::vector<HullRow> measure_hulls(const PointSet& set,
                                   const std::vector<HullEngine>& engines,
                                   const HullBenchOptions& options) {
  std::vector<Rounds> rounds(engines.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < engines.size(); ++i) {
      const std::size_t most = engines[i].max_points;
      if (most == 0 || set.points.size() <= most) rounds[i].go_on(engines[i], set.points, options);
    }
  }
  std::vector<std::optional<Timed>> results;
  for (const Rounds& r : rounds) results.push_back(r.result());
  const HullRun* exact = nullptr;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    if (engines[i].name == "quickhull" && results[i]) exact = &results[i]->run;
  }
  std::vector<HullRow> rows;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    HullRow row;
    row.set = set.name;
    row.origin = set.origin;
    row.engine = engines[i].name;
    row.n = set.points.size();
    row.is_peer = engines[i].is_peer;
    if (const auto& timed = results[i]) {
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
