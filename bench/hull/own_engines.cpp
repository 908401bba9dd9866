// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/engine.hpp"
#include "bench/stopwatch.hpp"
#include "geometry/triangle_mesh.hpp"
#include "hull/brute_force_hull.hpp"
#include "hull/chan_hull.hpp"
#include "hull/fast_hull.hpp"
#include "hull/gift_wrapping.hpp"
#include "hull/hybrid_hull.hpp"
#include "hull/quickhull.hpp"

namespace carpus::bench {
namespace {

template <typename Build>
HullEngine engine(std::string name, std::size_t max_points, Build build) {
  return {std::move(name), false, max_points, [build](std::span<const Vec3> points) {
            HullRun run;
            const Stopwatch watch;
            const hull::HullResult result = build(points);
            run.seconds = watch.seconds();
            run.ok = result.status == hull::HullStatus::Ok;
            run.vertices = result.polytope.vertices.size();
            run.facets = result.polytope.facets.size();
            run.volume_mm3 = volume_of(result.polytope.surface());
            run.points_discarded = static_cast<double>(result.statistics.points_discarded);
            return run;
          }};
}

}  // namespace

std::vector<HullEngine> own_hull_engines() {
  // Points up to which an O(n^4) and an O(n h) algorithm ends within a table's patience.
  constexpr std::size_t kBruteForceLimit = 150;
  constexpr std::size_t kWrappingLimit = 40'000;
  return {
      engine("fast", 0, [](auto points) { return hull::build_fast_hull(points); }),
      engine("quickhull", 0, [](auto points) { return hull::build_convex_hull(points); }),
      engine("chan", 0, [](auto points) { return hull::build_hull_by_chan(points); }),
      engine("hybrid", kWrappingLimit,
             [](auto points) { return hull::build_hull_by_hybrid(points); }),
      engine("gift_wrapping", kWrappingLimit,
             [](auto points) { return hull::build_hull_by_gift_wrapping(points); }),
      engine("brute_force", kBruteForceLimit,
             [](auto points) { return hull::build_hull_by_brute_force(points); }),
  };
}

}  // namespace carpus::bench
