// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/chan_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/rng.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/detail/face_polygon.hpp"
#include "hull/detail/hull_verification.hpp"
#include "hull/detail/large_points.hpp"
#include "hull/fast_hull.hpp"
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
std::vector<Vec3> large_distinct_points(std::uint64_t seed) {
  return without_duplicates(large_points(seed, 6000));
}

TEST(ChanHull, GivesTheSameBytesOnLargeInput) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    expect_same_bytes(large_distinct_points(seed), seed);
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

/// What Chan's algorithm asks for n points, and whether its hull is that of build_fast_hull.
std::uint64_t tests_of(const std::vector<Vec3>& points) {
  const HullResult expected = build_fast_hull(points);
  const HullResult found = build_hull_by_chan(points);
  EXPECT_EQ(found.status, HullStatus::Ok);
  EXPECT_EQ(found.polytope.vertices, expected.polytope.vertices);
  EXPECT_EQ(found.polytope.facets, expected.polytope.facets);
  return found.statistics.orientation_tests;
}

TEST(ChanHull, AsksAFewHundredTimesAPointWhereAllAreJoinedToTwo) {
  const std::uint64_t tests = tests_of(wheel(4000));
  EXPECT_LT(tests, 4000U * 400U);
  EXPECT_LT(tests_of(wheel(16'000)), 6 * tests);
  EXPECT_LT(tests_of(wheel(66'000)), 66'000U * 1000U);  // the first that wraps two large hulls
}

TEST(ChanHull, AsksLittleAboutFacesOfManyCorners) {
  const auto cone = [](std::size_t count) {
    std::vector<Vec3> points{{0, 0, 1}};
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(i);
      points.push_back({x, x * x, 0});
    }
    return points;
  };
  const auto prism = [](std::size_t count) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count / 2; ++i) {
      const auto x = static_cast<double>(i);
      for (const double z : {0.0, 1.0}) points.push_back({x, x * x, z});
    }
    return points;
  };
  const auto half_sphere = [](std::size_t count) {
    Rng rng(7);
    std::vector<Vec3> points;
    while (points.size() < count) {
      Vec3 p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
      p.z = std::max(p.z, 0.0);
      points.push_back(points.size() % 2 == 0 ? p : normalized_or({p.x, p.y, 0}, {1, 0, 0}));
    }
    return points;
  };
  const auto expect_few = [](const auto& points_of) {
    const std::uint64_t tests = tests_of(points_of(4000));
    EXPECT_LT(tests, 4000U * 400U);
    EXPECT_LT(tests_of(points_of(16'000)), 6 * tests);
  };
  expect_few(cone);
  expect_few(prism);
  expect_few(half_sphere);
}

}  // namespace
}  // namespace carpus::hull
