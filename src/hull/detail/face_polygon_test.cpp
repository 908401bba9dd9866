// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/face_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/rng.hpp"
#include "geometry/predicates.hpp"

namespace carpus::hull {
namespace {

std::vector<std::uint32_t> all_of(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

std::vector<Vec3> corners(const std::vector<Vec3>& points, const Vec3& below) {
  HullStatistics statistics;
  std::vector<Vec3> found;
  for (const std::uint32_t i : face_polygon(points, all_of(points), below, statistics)) {
    found.push_back(points[i]);
  }
  return found;
}

TEST(FacePolygon, GivesTheCornersOfASquareFromTheFirstAndTurnsRoundWithTheSide) {
  const std::vector<Vec3> points{{1, 1, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0, 0}, {2, 2, 0}, {0, 0, 0}};
  const std::vector<Vec3> seen_from_above{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<Vec3> seen_from_below{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}};
  EXPECT_EQ(corners(points, {0, 0, -1}), seen_from_above);
  EXPECT_EQ(corners(points, {0, 0, 1}), seen_from_below);
}

TEST(FacePolygon, GivesTheTwoEndsOfALine) {
  const std::vector<Vec3> points{{1, 2, 3}, {3, 6, 9}, {0, 0, 0}, {2, 4, 6}};
  const std::vector<Vec3> ends{{0, 0, 0}, {3, 6, 9}};
  EXPECT_EQ(corners(points, {0, 0, 1}), ends);
}

TEST(FacePolygon, NamesTheLowestOfDuplicates) {
  const std::vector<Vec3> points{{0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  HullStatistics statistics;
  const std::vector<std::uint32_t> expected{1, 2, 0};
  EXPECT_EQ(face_polygon(points, all_of(points), {0, 0, -1}, statistics), expected);
}

/// A polygon that turns left at each corner and has no point to the right of an edge.
void expect_polygon_of(const std::vector<Vec3>& points, const Vec3& below, std::uint64_t seed) {
  const std::vector<Vec3> p = corners(points, below);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3& next = p[(i + 1) % p.size()];
    ASSERT_LT(orient3d(p[i], next, p[(i + 2) % p.size()], below), 0) << "seed " << seed;
    for (const Vec3& q : points) ASSERT_LE(orient3d(p[i], next, q, below), 0) << "seed " << seed;
  }
}

TEST(FacePolygon, HoldsAllPointsOfTiltedAndUprightLattices) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Rng rng(seed);
    std::vector<Vec3> points{{0, 0, 0}, {7, 0, 0}, {0, 7, 0}};
    for (std::uint64_t i = rng.below(60); i > 0; --i) {
      points.push_back({static_cast<double>(rng.below(8)), static_cast<double>(rng.below(8)), 0});
    }
    for (Vec3& p : points) {
      if (seed % 4 == 1) p = {0, p.y, p.x};  // lexicographic order is that of y, then z
      if (seed % 4 == 2) p = {p.x, 3 * p.x, p.y};
      if (seed % 4 == 3) p = {p.x - p.y, p.y, 2 * p.x + 5 * p.y};
    }
    expect_polygon_of(points, {3, -100, 7}, seed);
    expect_polygon_of(points, {-40, 100, 20}, seed);
    if (HasFatalFailure()) return;
  }
}

TEST(FacePolygon, TakesFewTestsForManyCorners) {
  for (const std::size_t count : {1000U, 20'000U}) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(i * 7919 % count);
      points.push_back({x, x * x, 0});
    }
    HullStatistics statistics;
    EXPECT_EQ(face_polygon(points, all_of(points), {0, 0, 1}, statistics).size(), count);
    EXPECT_LT(statistics.orientation_tests, 4 * count);
  }
}

}  // namespace
}  // namespace carpus::hull
