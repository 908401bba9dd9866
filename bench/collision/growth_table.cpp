// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "bench/collision/tables.hpp"
#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

constexpr std::array<std::size_t, 7> kFacets{100, 316, 1000, 3162, 10'000, 31'623, 100'000};
constexpr std::size_t kPoses = 120;

/// What scans all vertices or takes long to build is left out beyond this.
constexpr std::size_t kMostForSlow = 10'000;

bool is_slow(const std::string& name) {
  return name.ends_with("_tree") || name.starts_with("quick_cd") || name == "seidel" ||
         name == "ivri" || name == "lp_scan" || name == "fcl_indep" || name == "fcl_convex" ||
         name == "epa" || name == "depth_exact";
}

/// A body like a carpal bone, all of whose points are corners.
std::unique_ptr<convex::ConvexBody> pebble(std::size_t facets, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < facets / 2 + 2; ++i) {
    const Vec3 d = random_direction(rng);
    points.push_back({9 * d.x, 6 * d.y, 5 * d.z});
  }
  return body_of(points, points.size(), seed);
}

}  // namespace

std::vector<CollisionRow> growth_table(const BenchOptions& options) {
  std::vector<PairEngine> engines = own_pair_engines();
  for (PairEngine& peer : peer_pair_engines()) engines.push_back(std::move(peer));
  std::vector<CollisionRow> rows;
  for (const std::size_t facets : kFacets) {
    std::fprintf(stderr, "%zu facets\n", facets);
    const auto first = pebble(facets, 1);
    const auto second = pebble(facets, 2);
    std::vector<PairScript> scripts;
    scripts.push_back(
        {first.get(), second.get(), make_poses("trajectory", *first, *second, kPoses, facets)});
    for (const PairEngine& engine : engines) {
      if (!options.wants(engine.name)) continue;
      if (facets > kMostForSlow && is_slow(engine.name)) continue;
      for (const bool cold : {false, true}) {
        rows.push_back(measure_verdicts(engine, cold ? "cold" : "warm", scripts, cold, options));
      }
    }
  }
  return rows;
}

std::string growth_text(const std::vector<CollisionRow>& rows) {
  struct Sums {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    std::string means;
  };
  std::map<std::pair<std::string, std::string>, Sums> fits;
  for (const CollisionRow& row : rows) {
    if (!row.ran || row.timing.mean <= 0) continue;
    Sums& s = fits[{row.pose_case, row.engine}];
    const double x = std::log(row.facets);
    const double y = std::log(row.timing.mean);
    s = {s.n + 1,      s.x + x,
         s.y + y,      s.xx + x * x,
         s.xy + x * y, s.means + format(" %9.3f%s", row.timing.mean * 1e6, row.agrees ? " " : "!")};
  }
  std::string text = format("%-27s%9s", "mean microseconds", "exponent");
  for (const std::size_t facets : kFacets) text += format(" %9zu ", facets);
  text += "\n";
  for (const auto& [key, s] : fits) {
    if (s.n < 3) continue;
    const double exponent = (s.n * s.xy - s.x * s.y) / (s.n * s.xx - s.x * s.x);
    text += format("%-6s %-20s %8.2f", key.first.c_str(), key.second.c_str(), exponent) + s.means +
            "\n";
  }
  return text;
}

}  // namespace carpus::bench
