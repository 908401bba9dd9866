// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/chan_hull.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/rng.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/detail/face_polygon.hpp"
#include "hull/detail/hull_hierarchy.hpp"
#include "hull/detail/hull_verification.hpp"
#include "hull/gift_wrapping.hpp"
#include "hull/quickhull.hpp"

namespace carpus::hull {
namespace {

std::vector<Vec3> without_duplicates(const std::vector<Vec3>& points) {
  std::vector<Vec3> unique;
  for (const std::uint32_t i : distinct_points(points)) unique.push_back(points[i]);
  return unique;
}

void expect_same_bytes(const std::vector<Vec3>& points, std::uint64_t seed) {
  const HullResult expected = build_convex_hull(points);
  const HullResult found = build_hull_by_chan(points);
  ASSERT_EQ(found.status, expected.status) << "seed " << seed;
  ASSERT_EQ(found.polytope.vertices, expected.polytope.vertices) << "seed " << seed;
  ASSERT_EQ(found.polytope.input_indices, expected.polytope.input_indices) << "seed " << seed;
  ASSERT_EQ(found.polytope.facets, expected.polytope.facets) << "seed " << seed;
  ASSERT_EQ(found.polytope.neighbours, expected.polytope.neighbours) << "seed " << seed;
  for (std::size_t f = 0; f < expected.polytope.planes.size(); ++f) {
    ASSERT_EQ(found.polytope.planes[f].normal, expected.polytope.planes[f].normal);
    ASSERT_EQ(found.polytope.planes[f].offset, expected.polytope.planes[f].offset);
  }
}

TEST(ChanHull, GivesTheSameBytesAsQuickhullOnDegenerateInput) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    expect_same_bytes(without_duplicates(random_points(seed)), seed);
    if (HasFatalFailure()) return;
  }
}

TEST(ChanHull, FulfilsItsContractWithDuplicates) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    std::vector<Vec3> points = random_points(seed);
    const std::vector<Vec3> copy = points;
    points.insert(points.end(), copy.begin(), copy.end());
    const HullResult result = build_hull_by_chan(points);
    if (result.status != HullStatus::Ok) continue;
    ASSERT_EQ(verify_hull(result.polytope, points), "") << "seed " << seed;
  }
}

/// Few corners, so that wrapping ends before everything is one group; many; and voxels.
std::vector<Vec3> large_points(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec3> points(6000);
  for (Vec3& p : points) {
    p = {rng.normal(), rng.normal(), rng.normal()};
    if (seed % 4 == 1) p = normalized_or(p, {1, 0, 0});
    const auto lattice = [&](std::uint64_t n) { return static_cast<double>(rng.below(n)); };
    if (seed % 4 == 2) p = {0.3 * lattice(30), 0.3 * lattice(30), 0.5 * lattice(30)};
    if (seed % 4 == 3) p = {lattice(60), lattice(60), lattice(2)};
  }
  return without_duplicates(points);
}

TEST(ChanHull, GivesTheSameBytesOnLargeInput) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    expect_same_bytes(large_points(seed), seed);
    if (HasFatalFailure()) return;
  }
}

TEST(ChanHull, StopsAtGroupsNoLargerThanTheHull) {
  Rng rng(5);
  std::vector<Vec3> points(20'000);
  for (Vec3& p : points) p = {rng.normal(), rng.normal(), rng.normal()};
  const HullResult chan = build_hull_by_chan(points);
  const HullResult wrapped = build_hull_by_gift_wrapping(points);
  EXPECT_LT(chan.polytope.vertices.size(), 256U);
  EXPECT_GT(chan.statistics.points_discarded, 10'000U);
  EXPECT_LT(chan.statistics.orientation_tests, wrapped.statistics.orientation_tests);
  EXPECT_EQ(chan.polytope.facets, wrapped.polytope.facets);
}

TEST(ChanHull, NamesInputWithoutAHull) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto status = [](std::vector<Vec3> points) { return build_hull_by_chan(points).status; };
  EXPECT_EQ(status({}), HullStatus::TooFewPoints);
  EXPECT_EQ(status(std::vector<Vec3>(50, Vec3{1, 2, 3})), HullStatus::Collinear);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}}), HullStatus::Coplanar);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, nan, 1}}), HullStatus::NotFinite);
  EXPECT_EQ(status({{0, 0, 0}, {1e200, 0, 0}, {0, 1, 0}, {0, 0, 1}}), HullStatus::ScaleRange);
}

TEST(HullHierarchy, TouchesWhereALinearSearchWould) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const HullResult hull = build_convex_hull(large_points(seed % 8));
    ASSERT_EQ(hull.status, HullStatus::Ok);
    const HullHierarchy hierarchy(hull.polytope);
    Rng rng(seed);
    for (int query = 0; query < 50; ++query) {
      // A line outside: beyond a supporting plane of the hull, in it.
      const Vec3 up = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {0, 0, 1});
      const Vec3 a = up * 200.0;
      const TurningLine line{a, a + any_perpendicular(up), {1e3, 1e3, 1e3}};
      HullStatistics statistics;
      const std::uint32_t w = hierarchy.touch(line, statistics);
      for (const Vec3& p : hull.polytope.vertices) {
        ASSERT_LE(orient3d(line.a, line.b, hull.polytope.vertices[w], p), 0) << "seed " << seed;
      }
    }
  }
}

TEST(HullHierarchy, AsksFewVerticesOfALargeHull) {
  Rng rng(3);
  std::vector<Vec3> points(20'000);
  for (Vec3& p : points) {
    p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
  }
  const HullResult hull = build_convex_hull(points);
  const HullHierarchy hierarchy(hull.polytope);
  HullStatistics statistics;
  for (int query = 0; query < 1000; ++query) {
    const Vec3 up = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {0, 0, 1});
    const TurningLine line{up * 2.0, up * 2.0 + any_perpendicular(up), {4, 4, 4}};
    static_cast<void>(hierarchy.touch(line, statistics));
  }
  // About 14 doublings; a linear search would ask 20 000.
  EXPECT_LT(statistics.orientation_tests, 1000U * 150U);
}

}  // namespace
}  // namespace carpus::hull
