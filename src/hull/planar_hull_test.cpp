// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/planar_hull.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/rng.hpp"
#include "hull/detail/planar_chan.hpp"

namespace carpus::hull {
namespace {

constexpr std::array kAll{PlanarAlgorithm::BruteForce, PlanarAlgorithm::GiftWrapping,
                          PlanarAlgorithm::Quickhull,  PlanarAlgorithm::GrahamScan,
                          PlanarAlgorithm::Chan,       PlanarAlgorithm::Hybrid,
                          PlanarAlgorithm::Fast};

std::vector<Vec2> random_points(std::uint64_t seed, std::uint64_t most) {
  Rng rng(seed);
  const std::uint64_t kind = rng.below(5);
  std::vector<Vec2> points;
  for (std::uint64_t i = 3 + rng.below(most); i > 0; --i) {
    const auto lattice = [&](std::uint64_t n) { return static_cast<double>(rng.below(n)); };
    Vec2 p{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (kind == 0) p = {lattice(4), lattice(4)};
    if (kind == 1) p = {0.1 * lattice(9), 0.3 * lattice(9)};
    if (kind == 2) p = {p.x, p.x + 1e-16 * lattice(4)};  // nearly one line
    if (kind == 3) {                                     // nearly one circle
      const double n = std::hypot(p.x, p.y);
      p = {p.x / n, p.y / n};
    }
    points.push_back(p);
  }
  return points;
}

/// By definition: strictly convex, counter-clockwise, holds all points, starts at the least.
void expect_hull(const std::vector<Vec2>& points, const std::vector<std::uint32_t>& corners) {
  ASSERT_GE(corners.size(), 3U);
  const auto at = [&](std::size_t i) { return points[corners[i % corners.size()]]; };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ASSERT_GT(orient2d(at(i), at(i + 1), at(i + 2)), 0);
    for (const Vec2& p : points) ASSERT_GE(orient2d(at(i), at(i + 1), p), 0);
    ASSERT_TRUE(at(0).x < at(i).x || (at(0).x == at(i).x && at(0).y <= at(i).y));
  }
}

TEST(PlanarHull, IsTheSameByEveryAlgorithm) {
  int hulls = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const std::vector<Vec2> points = random_points(seed, 40);
    const PlanarHullResult first = build_planar_hull(points, PlanarAlgorithm::GrahamScan);
    if (first.status == HullStatus::Ok) {
      expect_hull(points, first.corners);
      ++hulls;
    }
    for (const PlanarAlgorithm algorithm : kAll) {
      const PlanarHullResult result = build_planar_hull(points, algorithm);
      ASSERT_EQ(result.status, first.status) << "seed " << seed;
      ASSERT_EQ(result.corners, first.corners)
          << "seed " << seed << " algorithm " << static_cast<int>(algorithm);
    }
  }
  EXPECT_GT(hulls, 2800);
}

TEST(PlanarHull, KeepsTheCornersOfASquareLattice) {
  std::vector<Vec2> points;
  for (int i = 0; i < 400; ++i) points.push_back({0.1 * (i % 20), 0.1 * (i / 20)});
  for (const PlanarAlgorithm algorithm :
       {PlanarAlgorithm::GiftWrapping, PlanarAlgorithm::Quickhull, PlanarAlgorithm::GrahamScan,
        PlanarAlgorithm::Chan, PlanarAlgorithm::Hybrid, PlanarAlgorithm::Fast}) {
    const PlanarHullResult result = build_planar_hull(points, algorithm);
    EXPECT_EQ(result.corners, (std::vector<std::uint32_t>{0, 19, 399, 380}));
    EXPECT_GE(result.statistics.facets_created, 4U);
    EXPECT_GT(result.statistics.exact_fallbacks, 0U);
  }
}

TEST(PlanarHull, IsTheSameByChanInManyAndInOneGroup) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<Vec2> points = random_points(seed, 3000);
    const PlanarHullResult expected = build_planar_hull(points, PlanarAlgorithm::GrahamScan);
    const PlanarHullResult found = build_planar_hull(points, PlanarAlgorithm::Chan);
    ASSERT_EQ(found.status, expected.status) << "seed " << seed;
    ASSERT_EQ(found.corners, expected.corners) << "seed " << seed;
  }
}

TEST(PlanarHull, AsksLogarithmicallyManyVerticesForATangent) {
  constexpr std::size_t kCount = 50'000;
  std::vector<Vec2> circle;
  std::vector<std::uint32_t> polygon;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kCount;
    circle.push_back({std::cos(angle), std::sin(angle)});
    polygon.push_back(i);
  }
  for (int i = 0; i < 100; ++i) {
    const Vec2 from{1.5 * std::cos(0.7 * i), 1.5 * std::sin(0.7 * i)};
    HullStatistics statistics;
    const Vec2 best = circle[right_tangent(circle, polygon, from, statistics)];
    for (const Vec2& p : circle) ASSERT_GE(orient2d(from, best, p), 0);
    EXPECT_LT(statistics.orientation_tests, 45U);  // two for each of 15 halvings
  }
}

TEST(PlanarHull, DiscardsTheInsideWhereThereIsAFirstStage) {
  Rng rng(2);
  std::vector<Vec2> disc;
  while (disc.size() < 2000) {
    const Vec2 p{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (std::hypot(p.x, p.y) < 1) disc.push_back(p);
  }
  const auto discarded = [&](PlanarAlgorithm a) {
    return static_cast<double>(build_planar_hull(disc, a).statistics.points_discarded) / 2000;
  };
  EXPECT_NEAR(discarded(PlanarAlgorithm::Hybrid), 2 / 3.14159265, 0.04);  // a square in its circle
  EXPECT_EQ(discarded(PlanarAlgorithm::Fast), discarded(PlanarAlgorithm::Hybrid));
  EXPECT_EQ(discarded(PlanarAlgorithm::GiftWrapping), 0);
}

TEST(PlanarHull, NamesInputWithoutAHull) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const PlanarAlgorithm algorithm : kAll) {
    const auto status = [&](const std::vector<Vec2>& points) {
      return build_planar_hull(points, algorithm).status;
    };
    EXPECT_EQ(status({{0, 0}, {1, 1}}), HullStatus::TooFewPoints);
    EXPECT_EQ(status({{2, 2}, {2, 2}, {2, 2}}), HullStatus::Collinear);
    EXPECT_EQ(status({{0, 0}, {1, 2}, {2, 4}, {-1, -2}}), HullStatus::Collinear);
    EXPECT_EQ(status({{0, 0}, {1, nan}, {2, 4}}), HullStatus::NotFinite);
    EXPECT_EQ(status({{0, 0}, {1, 1e101}, {2, 4}}), HullStatus::ScaleRange);
    EXPECT_EQ(status({{0, 0}, {1, 0}, {0, 1}}), HullStatus::Ok);
  }
}

}  // namespace
}  // namespace carpus::hull
