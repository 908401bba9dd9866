// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/measure.hpp"

#include <algorithm>

#include "bench/collision/cycle_clock.hpp"
#include "bench/stopwatch.hpp"

namespace carpus::bench {
namespace {

using convex::PairQuery;
using convex::Verdict;

void score(Timing& counts, const TimedPose& pose, Verdict verdict) {
  if (verdict == Verdict::Unknown) {
    ++counts.unknown;
  } else if ((verdict == Verdict::Meet) != pose.meet) {
    ++(pose.is_near ? counts.wrong_near : counts.wrong);
  }
}

Timing time_verdicts(const PairEngine& engine,
                     const std::vector<PairScript>& scripts,
                     bool cold,
                     double budget_seconds) {
  const CycleClock clock;
  std::vector<std::unique_ptr<PairQuery>> queries;
  for (const PairScript& s : scripts) queries.push_back(engine.make(*s.first, *s.second));
  std::vector<std::vector<double>> passes;
  Timing counts;
  const Stopwatch watch;
  for (int pass = 0; pass < kQueryPasses && (pass == 0 || watch.seconds() < budget_seconds / 2);
       ++pass) {
    std::vector<double> seconds;
    for (std::size_t s = 0; s < scripts.size(); ++s) {
      const PoseScript& script = scripts[s].poses;
      PairQuery& query = *queries[s];
      query.forget();
      if (script.is_trajectory && !cold) (void)query.meets(script.poses.front().before);
      for (const TimedPose& pose : script.poses) {
        if (cold) {
          query.forget();
        } else if (!script.is_trajectory) {
          (void)query.meets(pose.before);
        }
        const std::uint64_t begin = CycleClock::now();
        const Verdict verdict = query.meets(pose.at);
        const std::uint64_t end = CycleClock::now();
        seconds.push_back(clock.seconds(begin, end));
        if (pass == 0) score(counts, pose, verdict);
      }
      if (watch.seconds() > budget_seconds) break;
    }
    passes.push_back(std::move(seconds));
  }
  // A pass that the budget cut short shortens all.
  std::size_t shortest = passes.front().size();
  for (const auto& p : passes) shortest = std::min(shortest, p.size());
  for (auto& p : passes) p.resize(shortest);
  Timing timing = timing_of(passes, clock.resolution_seconds());
  timing.wrong = counts.wrong;
  timing.wrong_near = counts.wrong_near;
  timing.unknown = counts.unknown;
  return timing;
}

}  // namespace

CollisionRow measure_verdicts(const PairEngine& engine,
                              const std::string& pose_case,
                              const std::vector<PairScript>& scripts,
                              bool cold,
                              const BenchOptions& options) {
  CollisionRow row;
  row.pose_case = pose_case;
  row.query = "boolean";
  row.engine = engine.name;
  row.is_peer = engine.is_peer;
  double facets = 0;
  for (const PairScript& s : scripts) {
    facets +=
        static_cast<double>(s.first->polytope().facets.size() + s.second->polytope().facets.size());
  }
  row.facets = facets / static_cast<double>(2 * scripts.size());
  const auto timing = run_capped<Timing>(
      options.caps, [&] { return time_verdicts(engine, scripts, cold, options.budget_seconds); });
  row.ran = timing.has_value() && timing->queries > 0;
  if (row.ran) {
    row.timing = *timing;
    row.agrees = timing->wrong == 0 && timing->unknown == 0;
  }
  return row;
}

}  // namespace carpus::bench
