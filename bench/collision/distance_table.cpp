// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distances with witness points and penetration depths, warm; errors are against long double.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/collision/cycle_clock.hpp"
#include "bench/collision/tables.hpp"
#include "bench/stopwatch.hpp"
#include "oracles/reference_distance.hpp"

namespace carpus::bench {
namespace {

using convex::ConvexBody;
using convex::PairQuery;

constexpr double kNearMm = 1;
constexpr double kAgreementMm = 1e-9;
constexpr std::size_t kDepthPoses = 2;  ///< a pair: the reference takes a tenth of a second
constexpr std::size_t kDistancePoses = 25;

struct GapCase {
  std::string name;
  double gap_mm = 0;
};

/// A pair, its poses, and the reference for each.
struct KnownScript {
  PairScript script;
  std::vector<oracles::DistanceBounds> reference;  ///< the true value lies between
};

KnownScript known(const ConvexBody& first,
                  const ConvexBody& second,
                  double gap_mm,
                  std::uint64_t seed) {
  KnownScript k;
  const std::size_t count = gap_mm > 0 ? kDistancePoses : kDepthPoses;
  k.script = {&first, &second, poses_at_gap(gap_mm, first, second, count, seed)};
  const auto a = oracles::body_of<long double>(first.polytope(), Mat3::identity(), {});
  for (const TimedPose& p : k.script.poses.poses) {
    const auto b =
        oracles::body_of<long double>(second.polytope(), p.at.rotation, p.at.translation);
    if (gap_mm > 0) {
      k.reference.push_back(oracles::reference_distance(a, b));
    } else {
      const long double depth = oracles::reference_depth(a, first.polytope(), b, second.polytope());
      k.reference.push_back({depth, depth});
    }
  }
  return k;
}

std::optional<double> ask(PairQuery& query, const convex::PairPose& pose, bool depth) {
  if (depth) {
    const auto p = query.penetration(pose);
    return p ? std::optional(p->depth_mm) : std::nullopt;
  }
  const auto c = query.closest(pose);
  return c ? std::optional(c->distance_mm) : std::nullopt;
}

Timing time_values(const PairEngine& engine,
                   const std::vector<KnownScript>& scripts,
                   bool depth,
                   double budget_seconds) {
  const CycleClock clock;
  std::vector<std::unique_ptr<PairQuery>> queries;
  for (const KnownScript& k : scripts) {
    queries.push_back(engine.make(*k.script.first, *k.script.second));
  }
  std::vector<std::vector<double>> passes;
  Timing found;
  const Stopwatch watch;
  for (int pass = 0; pass < kQueryPasses && (pass == 0 || watch.seconds() < budget_seconds / 2);
       ++pass) {
    std::vector<double> seconds;
    for (std::size_t s = 0; s < scripts.size() && watch.seconds() < budget_seconds; ++s) {
      PairQuery& query = *queries[s];
      for (std::size_t i = 0; i < scripts[s].reference.size(); ++i) {
        const TimedPose& pose = scripts[s].script.poses.poses[i];
        (void)ask(query, pose.before, depth);
        const std::uint64_t begin = CycleClock::now();
        const std::optional<double> value = ask(query, pose.at, depth);
        const std::uint64_t end = CycleClock::now();
        seconds.push_back(clock.seconds(begin, end));
        if (pass != 0) continue;
        if (!value) {
          ++found.missing;
        } else {
          const auto& r = scripts[s].reference[i];
          const long double error = std::max({0.0L, *value - r.upper_mm, r.lower_mm - *value});
          found.largest_error_mm = std::max(found.largest_error_mm, static_cast<double>(error));
        }
      }
    }
    passes.push_back(std::move(seconds));
  }
  std::size_t shortest = passes.front().size();
  for (const auto& p : passes) shortest = std::min(shortest, p.size());
  for (auto& p : passes) p.resize(shortest);
  Timing timing = timing_of(passes, clock.resolution_seconds());
  timing.missing = found.missing;
  timing.largest_error_mm = found.largest_error_mm;
  return timing;
}

}  // namespace

std::vector<CollisionRow> distance_table(const BoneSet& bones, const BenchOptions& options) {
  auto pairs = near_pairs(bones, kNearMm);
  if (options.pairs != 0 && pairs.size() > options.pairs) pairs.resize(options.pairs);
  std::vector<PairEngine> engines = own_pair_engines();
  for (PairEngine& peer : peer_pair_engines()) engines.push_back(std::move(peer));
  std::vector<CollisionRow> rows;
  for (const GapCase& gap :
       {GapCase{"apart_5mm", 5}, GapCase{"apart_1mm", 1}, GapCase{"gap_0.01mm", 0.01},
        GapCase{"deep_0.1mm", -0.1}, GapCase{"deep_1mm", -1}, GapCase{"deep_3mm", -3}}) {
    const bool depth = gap.gap_mm < 0;
    std::vector<KnownScript> scripts;
    for (const auto& [i, j] : pairs) {
      scripts.push_back(known(*bones.bones[i].body, *bones.bones[j].body, gap.gap_mm, i * 100 + j));
    }
    std::fprintf(stderr, "%s\n", gap.name.c_str());
    for (const PairEngine& engine : engines) {
      if (!options.wants(engine.name)) continue;
      if (depth ? !engine.gives_depth : !engine.gives_distance) continue;
      CollisionRow row{gap.name,
                       depth ? "depth" : "distance",
                       engine.name,
                       engine.is_peer,
                       bones.mean_facets(),
                       false,
                       {},
                       false,
                       0};
      const auto timing = run_capped<Timing>(options.caps, [&] {
        return time_values(engine, scripts, depth, options.budget_seconds);
      });
      row.ran = timing.has_value() && timing->queries > 0;
      if (row.ran) {
        row.timing = *timing;
        row.agrees = timing->missing == 0 && timing->largest_error_mm <= kAgreementMm;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace carpus::bench
