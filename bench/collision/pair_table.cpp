// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "bench/collision/tables.hpp"

namespace carpus::bench {
namespace {

constexpr double kNearMm = 1;

}  // namespace

std::vector<CollisionRow> pair_table(const BoneSet& bones, bool cold, const BenchOptions& options) {
  auto pairs = near_pairs(bones, kNearMm);
  if (options.pairs != 0 && pairs.size() > options.pairs) pairs.resize(options.pairs);
  std::vector<PairEngine> engines = own_pair_engines();
  for (PairEngine& peer : peer_pair_engines()) engines.push_back(std::move(peer));
  std::vector<CollisionRow> rows;
  for (const std::string& pose_case : pose_cases()) {
    std::vector<PairScript> scripts;
    for (const auto& [i, j] : pairs) {
      const convex::ConvexBody& first = *bones.bones[i].body;
      const convex::ConvexBody& second = *bones.bones[j].body;
      scripts.push_back(
          {&first, &second, make_poses(pose_case, first, second, options.poses, i * 100 + j)});
    }
    std::fprintf(stderr, "%s, %zu pairs\n", pose_case.c_str(), scripts.size());
    for (const PairEngine& engine : engines) {
      if (!options.wants(engine.name)) continue;
      rows.push_back(measure_verdicts(engine, pose_case, scripts, cold, options));
    }
  }
  return rows;
}

}  // namespace carpus::bench
