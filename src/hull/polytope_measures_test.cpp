// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/polytope_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "geometry/aabb.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::hull {
namespace {

std::vector<Vec3> cube(double side) {
  std::vector<Vec3> points;
  for (const double x : {0.0, side}) {
    for (const double y : {0.0, side}) {
      for (const double z : {0.0, side}) points.push_back({x, y, z});
    }
  }
  return points;
}

TEST(PolytopeMeasures, OfTheLargestAndTheSmallestCubes) {
  for (const double side : {1e-100, 1e-60, 3.0, 1e60, 1e100}) {
    const PolytopeMeasures m = measures_of(build_fast_hull(cube(side)).polytope);
    EXPECT_NEAR(m.volume_mm3 / (side * side * side), 1, 1e-14) << side;
    EXPECT_NEAR(m.area_mm2 / (side * side), 6, 1e-13) << side;
    for (const double c : {m.centroid.x, m.centroid.y, m.centroid.z}) {
      EXPECT_NEAR(c / side, 0.5, 1e-14) << side;
    }
  }
}

/// The points lie in a tilted plane but for the rounding of their heights.
TEST(PolytopeMeasures, OfHullsThatAreFlatButForRounding) {
  Rng rng(1);
  int found = 0;
  for (int set = 0; set < 300; ++set) {
    std::vector<Vec3> points;
    for (int i = 0; i < 30; ++i) {
      const double x = rng.uniform(-1, 1);
      const double y = rng.uniform(-1, 1);
      points.push_back({x, y, 0.1 * x + 0.7 * y});
    }
    const HullResult hull = build_fast_hull(points);
    if (hull.status != HullStatus::Ok) continue;
    ++found;
    const PolytopeMeasures m = measures_of(hull.polytope);
    EXPECT_GT(m.volume_mm3, 0);
    EXPECT_LT(m.volume_mm3, 1e-15);
    Aabb box;
    for (const Vec3& p : points) box.include(p);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GE(m.centroid[i], box.low[i]);
      EXPECT_LE(m.centroid[i], box.high[i]);
    }
  }
  EXPECT_GT(found, 250);
}

TEST(PolytopeMeasures, OfAFlatPyramidAreExact) {
  const std::vector<Vec3> points{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.25, 0.25, 1 + 0x1p-52}};
  const PolytopeMeasures m = measures_of(build_fast_hull(points).polytope);
  EXPECT_DOUBLE_EQ(m.volume_mm3, 0x1p-52 / 6);
  EXPECT_NEAR(m.centroid.x, (0 + 1 + 0 + 0.25) / 4, 1e-15);
  EXPECT_NEAR(m.centroid.y, (0 + 0 + 1 + 0.25) / 4, 1e-15);
}

}  // namespace
}  // namespace carpus::hull
