// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/rng.hpp"
#include "hull/quickhull.hpp"
#include "oracles/brute_force_hull.hpp"

namespace carpus {
namespace {

TEST(HullOracle, AgreesWithTheEnumerationOfAllPlanes) {
  int hulls = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Rng rng(seed);
    const std::uint64_t count = 4 + rng.below(9);
    const std::uint64_t kind = rng.below(4);
    std::vector<Vec3> points;
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto coordinate = [&] {
        const auto n = static_cast<double>(rng.below(3));
        return kind == 0 ? n : (kind == 1 ? 0.1 * n : rng.uniform(-1, 1));
      };
      points.push_back({coordinate(), coordinate(), coordinate()});
      if (kind == 3 && i > 2) points.back() = (points[0] + points[1] + points.back()) / 3;
    }
    const hull::HullResult result = hull::build_convex_hull(points);
    const std::vector<Vec3> expected = oracles::brute_force_corners(points);
    std::vector<Vec3> found = result.polytope.vertices;
    std::sort(found.begin(), found.end(), [](const Vec3& a, const Vec3& b) {
      return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
    });
    if (result.status == hull::HullStatus::Coplanar) continue;  // the oracle sees a flat polygon
    ASSERT_EQ(found, expected) << "seed " << seed;
    hulls += result.status == hull::HullStatus::Ok;
  }
  EXPECT_GT(hulls, 1000);
}

}  // namespace
}  // namespace carpus
