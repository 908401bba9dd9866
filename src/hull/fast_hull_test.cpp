// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/fast_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "core/rng.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/quickhull.hpp"

namespace carpus::hull {
namespace {

using Coordinates = std::tuple<double, double, double>;

/// Each position once, in the order of the first: which of several equal points becomes the vertex
/// is not specified.
std::vector<Vec3> without_duplicates(const std::vector<Vec3>& points) {
  std::set<Coordinates> seen;
  std::vector<Vec3> unique;
  for (const Vec3& p : points) {
    if (seen.insert({p.x, p.y, p.z}).second) unique.push_back(p);
  }
  return unique;
}

std::set<Coordinates> corners_of(const HullResult& hull) {
  std::set<Coordinates> corners;
  for (const Vec3& p : hull.polytope.vertices) corners.insert({p.x, p.y, p.z});
  return corners;
}

void expect_same_as_quickhull(const std::vector<Vec3>& with_duplicates, std::uint64_t seed) {
  ASSERT_EQ(corners_of(build_fast_hull(with_duplicates)),
            corners_of(build_convex_hull(with_duplicates)));
  const std::vector<Vec3> points = without_duplicates(with_duplicates);
  const HullResult expected = build_convex_hull(points);
  const HullResult result = build_fast_hull(points);
  ASSERT_EQ(result.status, expected.status) << "seed " << seed;
  ASSERT_EQ(result.polytope.vertices, expected.polytope.vertices) << "seed " << seed;
  ASSERT_EQ(result.polytope.facets, expected.polytope.facets) << "seed " << seed;
  ASSERT_EQ(result.polytope.neighbours, expected.polytope.neighbours) << "seed " << seed;
  for (std::size_t f = 0; f < expected.polytope.planes.size(); ++f) {
    ASSERT_EQ(result.polytope.planes[f].normal, expected.polytope.planes[f].normal);
    ASSERT_EQ(result.polytope.planes[f].offset, expected.polytope.planes[f].offset);
  }
}

TEST(FastHull, GivesTheSameBytesAsQuickhullOnDegenerateInput) {
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    expect_same_as_quickhull(random_points(seed), seed);
    if (HasFatalFailure()) return;
  }
}

TEST(FastHull, GivesTheSameBytesAsQuickhullOnLargeInput) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Rng rng(seed);
    std::vector<Vec3> points(20'000);
    for (Vec3& p : points) {
      p = {rng.normal(), rng.normal(), rng.normal()};
      if (seed % 3 == 1) p = normalized_or(p, {1, 0, 0}) * 20.0 + Vec3{300, -200, 90};
      if (seed % 3 == 2)
        p = {0.3 * static_cast<double>(rng.below(40)), 0.3 * static_cast<double>(rng.below(40)),
             0.5 * static_cast<double>(rng.below(40))};
    }
    expect_same_as_quickhull(points, seed);
    if (HasFatalFailure()) return;
  }
}

/// So many on the surface that the growing goes on by cells; rounded to a lattice, so that points
/// repeat and facets are coplanar.
TEST(FastHull, GivesTheSameBytesAsQuickhullCellByCell) {
  for (const double spacing : {1e-6, 0.125}) {
    Rng rng(11);
    std::vector<Vec3> points(100'000);
    for (Vec3& p : points) {
      const Vec3 on_ball = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
      p = {30 * on_ball.x, 20 * on_ball.y, 10 * on_ball.z};
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = spacing * std::round(p[axis] / spacing);
    }
    expect_same_as_quickhull(points, 11);
    if (HasFatalFailure()) return;
  }
}

TEST(FastHull, SaysHowManyPointsItPassedOver) {
  Rng rng(4);
  std::vector<Vec3> points;
  for (int i = 0; i < 20'000; ++i) points.push_back({rng.normal(), rng.normal(), rng.normal()});
  const HullStatistics statistics = build_fast_hull(points).statistics;
  EXPECT_GT(statistics.points_discarded, 18'000U);
  EXPECT_LT(statistics.points_discarded, 20'000U);
}

TEST(FastHull, NamesInputWithoutAHull) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(build_fast_hull({}).status, HullStatus::TooFewPoints);
  EXPECT_EQ(build_fast_hull(std::vector<Vec3>(50, Vec3{1, 2, 3})).status, HullStatus::Collinear);
  EXPECT_EQ(build_fast_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}}).status,
            HullStatus::Coplanar);
  EXPECT_EQ(build_fast_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, nan, 1}}).status,
            HullStatus::NotFinite);
  EXPECT_EQ(
      build_fast_hull(std::vector<Vec3>{{0, 0, 0}, {1e200, 0, 0}, {0, 1, 0}, {0, 0, 1}}).status,
      HullStatus::ScaleRange);
}

}  // namespace
}  // namespace carpus::hull
