// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/quickhull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/rng.hpp"
#include "geometry/mat3.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/detail/hull_verification.hpp"

namespace carpus::hull {
namespace {

TEST(Quickhull, FulfilsItsContractOnDegenerateInput) {
  int hulls = 0;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    const std::vector<Vec3> points = random_points(seed);
    const HullResult result = build_convex_hull(points);
    if (result.status != HullStatus::Ok) {
      EXPECT_TRUE(result.polytope.facets.empty());
      continue;
    }
    ++hulls;
    ASSERT_EQ(verify_hull(result.polytope, points), "") << "seed " << seed;
  }
  EXPECT_GT(hulls, 5000);
}

TEST(Quickhull, KeepsOnlyCornersOfASampledCube) {
  std::vector<Vec3> points;
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    points.push_back({0.3 * (i % 9), 0.3 * (i / 9 % 9), 0.3 * (i / 81)});
  }
  const HullResult result = build_convex_hull(points);
  ASSERT_EQ(result.status, HullStatus::Ok);
  EXPECT_EQ(result.polytope.vertices.size(), 8U);
  EXPECT_EQ(result.polytope.facets.size(), 12U);
  EXPECT_EQ(verify_hull(result.polytope, points), "");
  EXPECT_NEAR(volume_of(result.polytope.surface()), std::pow(2.4, 3), 1e-12);
}

TEST(Quickhull, IsIdempotentAndIndependentOfOrder) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    std::vector<Vec3> points = random_points(seed);
    const HullResult first = build_convex_hull(points);
    if (first.status != HullStatus::Ok) continue;
    const HullResult again = build_convex_hull(first.polytope.vertices);
    ASSERT_EQ(again.polytope.vertices, first.polytope.vertices);
    ASSERT_EQ(again.polytope.facets, first.polytope.facets);

    Rng rng(seed);
    for (std::size_t i = points.size() - 1; i > 0; --i)
      std::swap(points[i], points[rng.below(i + 1)]);
    const auto sorted = [](std::vector<Vec3> v) {
      std::sort(v.begin(), v.end(), [](const Vec3& a, const Vec3& b) {
        return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
      });
      return v;
    };
    ASSERT_EQ(sorted(build_convex_hull(points).polytope.vertices), sorted(first.polytope.vertices));
  }
}

TEST(Quickhull, MovesWithARigidMotion) {
  Rng rng(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) points.push_back({rng.normal(), rng.normal(), rng.normal()});
  const HullResult still = build_convex_hull(points);
  const Mat3 turn = rotation_about(normalized_or({1, 2, 3}, {}), 0.7);
  for (Vec3& p : points) p = turn * p + Vec3{5, -7, 100};
  const HullResult moved = build_convex_hull(points);
  EXPECT_EQ(moved.polytope.input_indices, still.polytope.input_indices);
  EXPECT_EQ(moved.polytope.facets, still.polytope.facets);
}

TEST(Quickhull, NamesInputWithoutAHull) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto status = [](const std::vector<Vec3>& points) {
    return build_convex_hull(points).status;
  };
  EXPECT_EQ(status({}), HullStatus::TooFewPoints);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), HullStatus::TooFewPoints);
  EXPECT_EQ(status(std::vector<Vec3>(10, Vec3{0.1, 0.2, 0.3})), HullStatus::Collinear);
  EXPECT_EQ(status({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {-3, -6, -9}}), HullStatus::Collinear);
  EXPECT_EQ(status({{0, 0, 1}, {3, 0, 1}, {0, 5, 1}, {2, 2, 1}, {1, 1, 1}}), HullStatus::Coplanar);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}}), HullStatus::NotFinite);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, inf}}), HullStatus::NotFinite);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e101}}), HullStatus::ScaleRange);
  EXPECT_EQ(status({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-101}}), HullStatus::ScaleRange);
}

TEST(Quickhull, WorksAtTheEndsOfTheRange) {
  for (const double scale : {1e-99, 1e-60, 1e60, 0.4e100}) {
    Rng rng(5);
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) {
      points.push_back(Vec3{rng.uniform(0.5, 2), rng.uniform(0.5, 2), rng.uniform(0.5, 2)} * scale);
    }
    const HullResult result = build_convex_hull(points);
    ASSERT_EQ(result.status, HullStatus::Ok) << scale;
    EXPECT_EQ(verify_hull(result.polytope, points), "") << scale;
  }
  const std::vector<Vec3> sliver{{0, 0, 0}, {1e100, 0, 0}, {0, 1, 0}, {0, 0, 1e-100}, {1, 1, 0}};
  EXPECT_EQ(build_convex_hull(sliver).status, HullStatus::Ok);
}

TEST(Quickhull, SeesAPointOneBitAboveAPlane) {
  std::vector<Vec3> points;
  for (int i = 0; i < 25; ++i) points.push_back({0.1 * (i % 5), 0.1 * (i / 5), 0.3});
  EXPECT_EQ(build_convex_hull(points).status, HullStatus::Coplanar);
  points[12].z = std::nextafter(0.3, 1.0);
  const HullResult result = build_convex_hull(points);
  ASSERT_EQ(result.status, HullStatus::Ok);
  EXPECT_EQ(result.polytope.vertices.size(), 5U);
  EXPECT_EQ(verify_hull(result.polytope, points), "");
}

TEST(Quickhull, CountsItsWork) {
  Rng rng(4);
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back({rng.normal(), rng.normal(), rng.normal()});
  const HullResult result = build_convex_hull(points);
  EXPECT_GE(result.statistics.facets_created, result.polytope.facets.size());
  EXPECT_GT(result.statistics.orientation_tests, 1000U);
  EXPECT_LT(result.statistics.exact_fallbacks, result.statistics.orientation_tests / 20);
}

TEST(Quickhull, GivesPlanesThatContainTheirOwnCorners) {
  Rng rng(6);
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back({rng.normal(), rng.normal(), rng.normal() + 80});
  const ConvexPolytope hull = build_convex_hull(points).polytope;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    EXPECT_NEAR(length(hull.planes[f].normal), 1, 1e-15);
    for (const std::uint32_t v : hull.facets[f]) {
      EXPECT_LE(dot(hull.planes[f].normal, hull.vertices[v]), hull.planes[f].offset);
    }
    for (const Vec3& p : points) EXPECT_LE(hull.planes[f].signed_distance(p), 1e-12);
  }
}

}  // namespace
}  // namespace carpus::hull
