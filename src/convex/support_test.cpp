// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "convex/bodies_test_support.hpp"
#include "geometry/exact_number.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::convex {
namespace {

double highest_by_scan(const SupportGraph& graph, const Vec3& d) {
  double best = -std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < graph.size(); ++i) best = std::max(best, dot(graph.corner(i), d));
  return best;
}

/// Random, along axes and diagonals, along normals of faces and edges (plateaus), nearly so.
Vec3 some_direction(Rng& rng, const ConvexBody& body) {
  const auto lattice = [&] { return static_cast<double>(rng.below(3)) - 1; };
  switch (rng.below(4)) {
    case 0:
      return test::random_direction(rng) * rng.uniform(1e-6, 1e6);
    case 1:
      return {lattice(), lattice(), lattice()};
    case 2:
      return body.polytope().planes[rng.below(body.polytope().planes.size())].normal;
    default:
      return body.polytope().planes[rng.below(body.polytope().planes.size())].normal +
             test::random_direction(rng) * 1e-13;
  }
}

void expect_walks_equal_scans(const ConvexBody& body, std::uint64_t count) {
  const SupportGraph& graph = body.derived<SupportGraph>();
  Rng rng(5);
  std::uint32_t last = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec3 d = some_direction(rng, body);
    const double expected = highest_by_scan(graph, d);
    const double tolerance = 8 * kRoundoff * graph.radius_mm() * length(d);
    const auto from = static_cast<std::uint32_t>(rng.below(graph.size()));
    EXPECT_NEAR(dot(graph.corner(graph.climb(d, from)), d), expected, tolerance);
    last = graph.climb_with_table(d, last);
    EXPECT_NEAR(dot(graph.corner(last), d), expected, tolerance);
  }
}

TEST(SupportGraph, FindsTheHighestCornerOfEverySmallSolidFromEveryStart) {
  for (const test::Solid& solid : test::small_solids()) {
    SCOPED_TRACE(solid.name);
    expect_walks_equal_scans(solid.body, test::cases(2000));
  }
}

TEST(SupportGraph, CertainClimbsBoundEveryCornerAndAreMostlyCertain) {
  for (const test::Solid& solid : test::small_solids()) {
    SCOPED_TRACE(solid.name);
    const SupportGraph& graph = solid.body.derived<SupportGraph>();
    Rng rng(6);
    int certain = 0;
    const int count = static_cast<int>(test::cases(1000));
    for (int i = 0; i < count; ++i) {
      const Vec3 d = some_direction(rng, solid.body);
      const CertainTop top =
          graph.certain_climb(d, static_cast<std::uint32_t>(rng.below(graph.size())));
      if (!top.is_certain) continue;
      ++certain;
      const ExactVec3 direction(d);
      const ExactVec3 centre(graph.centre());
      for (std::uint32_t v = 0; v < graph.size(); ++v) {
        const ExactNumber height = dot(direction, ExactVec3(solid.body.vertices()[v]) - centre);
        EXPECT_LE((height - ExactNumber(top.reach)).sign(), 0);
      }
      const double tolerance = 32 * kRoundoff * graph.radius_mm() * length(d);
      EXPECT_LE(top.reach, highest_by_scan(graph, d) + 2 * tolerance + kUnderflowBound);
    }
    EXPECT_GT(certain, count / 5);
    EXPECT_FALSE(graph.certain_climb({}, 0).is_certain);
    EXPECT_FALSE(graph.certain_climb({std::nan(""), 0, 1}, 0).is_certain);
  }
}

TEST(SupportGraph, FindsTheHighestCornerOfRoundSolids) {
  Rng rng(6);
  expect_walks_equal_scans(test::body_of(test::lattice_ball_points(9)), test::cases(2000));
  expect_walks_equal_scans(test::body_of(test::prism_points(64, 3, 40)), test::cases(2000));
  expect_walks_equal_scans(test::body_of(test::round_points(rng, 800, {30, 12, 9})),
                           test::cases(2000));
}

TEST(SupportGraph, LosesNoDigitsFarFromTheOrigin) {
  const ConvexBody far =
      test::shifted(test::body_of(test::lattice_ball_points(5)), {1e6, -2e6, 3e6});
  expect_walks_equal_scans(far, test::cases(1000));
  EXPECT_NEAR(far.derived<SupportGraph>().radius_mm(), 5, 1e-8);
}

TEST(SupportGraph, StartsNearTheAnswerFromTheTable) {
  Rng rng(7);
  const ConvexBody body = test::body_of(test::round_points(rng, 500, {20, 15, 10}));
  const SupportGraph& graph = body.derived<SupportGraph>();
  int exact = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 d = test::random_direction(rng);
    const std::uint32_t start = graph.near(d);
    const double lost = highest_by_scan(graph, d) - dot(graph.corner(start), d);
    EXPECT_LT(lost, 0.5);  // a cell is 7 degrees wide
    exact += lost <= 0 ? 1 : 0;
  }
  EXPECT_GT(exact, kCount / 2);
}

TEST(SupportGraph, StaysWhereItIsForADirectionThatIsNone) {
  const ConvexBody body = test::body_of(test::lattice_ball_points(3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Vec3& d : {Vec3{}, Vec3{nan, 0, 1}, Vec3{infinity, -infinity, 0}}) {
    EXPECT_LT(body.derived<SupportGraph>().climb(d, 4), body.vertices().size());
    EXPECT_LT(body.derived<SupportGraph>().climb_with_table(d, 4), body.vertices().size());
  }
  EXPECT_EQ(body.derived<SupportGraph>().climb({}, 4), 4U);
}

}  // namespace
}  // namespace carpus::convex
