// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/polar_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "convex/bodies_test_support.hpp"
#include "core/rng.hpp"
#include "geometry/exact_number.hpp"

namespace carpus::convex {
namespace {

std::vector<std::pair<std::string, ConvexBody>> many_bodies() {
  Rng rng(7);
  std::vector<std::pair<std::string, ConvexBody>> bodies;
  for (const int points : {4, 6, 20, 150, 500}) {
    bodies.emplace_back("pebble " + std::to_string(points), test::pebble(rng, points));
  }
  bodies.emplace_back("cube", test::box({4, 4, 4}));
  bodies.emplace_back("bar", test::box({0.5, 0.7, 40}));
  bodies.emplace_back("octahedron", test::octahedron(5));
  bodies.emplace_back("prism", test::prism(32, 3, 5));
  bodies.emplace_back("lattice ball", test::lattice_ball(5));
  return bodies;
}

/// Random directions, and lattice ones that hit faces, edges and corners of symmetric solids.
Vec3 any_query(Rng& rng) {
  if (rng.below(2) == 0) return test::random_direction(rng) * rng.uniform(0.1, 30);
  const auto c = [&] { return static_cast<double>(rng.below(7)) - 3; };
  return {c(), c(), c()};
}

TEST(PolarGraph, EndsEveryWalkAtTheLargestRowOfAFullScan) {
  for (const auto& [name, body] : many_bodies()) {
    const PolarGraph graph(body);
    ASSERT_TRUE(graph.is_usable()) << name;
    ASSERT_EQ(graph.size(), body.faces().size());
    Rng rng(11);
    double steps = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 d = any_query(rng);
      const double scanned = graph.scan(d).gauge;
      const PolarTop by_table = graph.top(d);
      const auto start = static_cast<std::uint32_t>(rng.below(graph.size()));
      // Ties end on either face; their rows differ in the last bit.
      const double tolerance = 1e-13 * (1 + std::abs(scanned));
      EXPECT_NEAR(by_table.gauge, scanned, tolerance) << name;
      EXPECT_NEAR(graph.climb(start, d).gauge, scanned, tolerance) << name;
      steps += by_table.steps;
    }
    EXPECT_LT(steps / 2000, 1.5) << name;
  }
}

TEST(PolarGraph, HoldsEveryVertexWithinItsReachExactly) {
  for (const auto& [name, body] : many_bodies()) {
    const PolarGraph graph(body);
    for (std::uint32_t f = 0; f < graph.size(); ++f) {
      const ExactVec3 p(graph.row(f).normal());
      bool is_tight = false;
      for (const Vec3& v : body.vertices()) {
        const ExactNumber gauge = dot(p, ExactVec3(v) - ExactVec3(graph.origin()));
        EXPECT_LE((gauge - ExactNumber(graph.reach())).sign(), 0) << name;
        is_tight = is_tight || gauge.to_double() > 1 - 1e-13;
      }
      EXPECT_TRUE(is_tight) << name;
    }
    EXPECT_LT(graph.reach() - 1, 1e-12) << name;
  }
}

TEST(PolarGraph, BoundsTheGaugeFromTheVertices) {
  for (const auto& [name, body] : many_bodies()) {
    const PolarGraph graph(body);
    Rng rng(13);
    for (int i = 0; i < 500; ++i) {
      const Vec3 d = any_query(rng);
      const PolarTop top = graph.top(d);
      const double bound = graph.gauge_bound(top.face, d);
      EXPECT_GE(bound, top.gauge) << name;
      EXPECT_LE(bound, top.gauge + 1e-12 * (1 + top.gauge)) << name;
      // Any face gives a bound; only its tightness depends on the face.
      const auto other = static_cast<std::uint32_t>(rng.below(graph.size()));
      EXPECT_GE(graph.gauge_bound(other, d), top.gauge * (1 - 1e-14)) << name;
    }
  }
}

TEST(PolarGraph, StartsSomewhereForWhatIsNoDirection) {
  const ConvexBody body = test::box({1, 2, 3});
  const PolarGraph graph(body);
  for (const double c : {0.0, 1e-310, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_LT(graph.top({c, c, c}).face, 6U);
    EXPECT_LT(graph.top({c, 1, 2}).face, 6U);
  }
}

TEST(PolarGraph, KnowsBallsInsideAndAroundTheBody) {
  const ConvexBody bar = test::box({1, 2, 30});
  const PolarGraph graph(bar);
  EXPECT_LE(graph.inner_radius_mm(), 1);
  EXPECT_NEAR(graph.inner_radius_mm(), 1, 1e-12);
  EXPECT_GE(graph.outer_radius_mm() * graph.outer_radius_mm(), 905);
  EXPECT_NEAR(graph.outer_radius_mm() * graph.outer_radius_mm(), 905, 1e-10);
}

TEST(PolarGraph, SaysWhichBodiesAreTooThinForDoubles) {
  const ConvexBody sheet = test::box({10, 10, 1e-13});
  EXPECT_FALSE(PolarGraph(sheet).is_usable());
  const ConvexBody far =
      test::body_of({{1e15, 0, 0}, {1e15 + 1, 0, 0}, {1e15, 1, 0}, {1e15, 0, 1}, {1e15 + 1, 1, 1}});
  const PolarGraph far_graph(far);  // corners are what they are: a small body far away
  EXPECT_TRUE(far_graph.is_usable());
  const ConvexBody tiny = test::box({1e-60, 1e-60, 1e-60});
  EXPECT_FALSE(PolarGraph(tiny).is_usable());
}

// What the walk must not be done on. Both pitfalls as the textbook rows a . x <= d make them.

/// Greedy walk over nodes with values; returns whether it ended at the largest.
bool reaches_the_top(const std::vector<double>& value,
                     const std::vector<std::vector<std::uint32_t>>& neighbours,
                     std::uint32_t start) {
  std::uint32_t at = start;
  while (true) {
    std::uint32_t best = at;
    for (const std::uint32_t n : neighbours[at]) {
      if (value[n] > value[best]) best = n;
    }
    if (best == at) break;
    at = best;
  }
  return value[at] >= *std::max_element(value.begin(), value.end()) - 1e-9;
}

/// Share of walks that stick, over random points outside and inside the body.
double share_stuck(const std::vector<Plane>& planes,
                   const std::vector<std::vector<std::uint32_t>>& neighbours,
                   const Vec3& origin,
                   bool is_scaled) {
  Rng rng(17);
  int stuck = 0;
  constexpr int kWalks = 2000;
  for (int i = 0; i < kWalks; ++i) {
    const Vec3 d = test::random_direction(rng) * rng.uniform(1, 12);
    std::vector<double> value;
    for (const Plane& p : planes) {
      const double height = p.offset - dot(p.normal, origin);
      value.push_back(is_scaled ? dot(p.normal, d) / height : dot(p.normal, d) - height);
    }
    const auto start = static_cast<std::uint32_t>(rng.below(planes.size()));
    stuck += reaches_the_top(value, neighbours, start) ? 0 : 1;
  }
  return static_cast<double>(stuck) / kWalks;
}

std::vector<std::vector<std::uint32_t>> of_facets(const ConvexPolytope& p) {
  std::vector<std::vector<std::uint32_t>> lists;
  for (const auto& n : p.neighbours) lists.emplace_back(n.begin(), n.end());
  return lists;
}

TEST(PolarGraphPitfall, WalksStickOnRowsThatAreNotScaledToOne) {
  Rng rng(19);
  const ConvexBody body = test::pebble(rng, 300);
  const ConvexPolytope& p = body.polytope();
  EXPECT_GT(share_stuck(p.planes, of_facets(p), body.interior_point(), false), 0.02);
  EXPECT_EQ(share_stuck(p.planes, of_facets(p), body.interior_point(), true), 0);
}

TEST(PolarGraphPitfall, WalksStickOnTrianglesOfOneFace) {
  std::vector<std::pair<std::string, ConvexBody>> solids;
  solids.emplace_back("prism", test::prism(32, 3, 5));
  solids.emplace_back("lattice ball", test::lattice_ball(6));
  for (const auto& [name, body] : solids) {
    const ConvexPolytope& p = body.polytope();
    EXPECT_GT(share_stuck(p.planes, of_facets(p), body.interior_point(), true), 0.1) << name;
    std::vector<Plane> merged;
    std::vector<std::vector<std::uint32_t>> neighbours;
    for (std::uint32_t f = 0; f < body.faces().size(); ++f) {
      merged.push_back(body.face_plane(f));
      neighbours.push_back(body.faces()[f].neighbours);
    }
    EXPECT_EQ(share_stuck(merged, neighbours, body.interior_point(), true), 0) << name;
  }
}

TEST(PolarGraph, FacesAboutAVertexAreThoseThatHoldIt) {
  for (const auto& [name, body] : many_bodies()) {
    const PolarGraph graph(body);
    for (std::uint32_t v = 0; v < body.vertices().size(); ++v) {
      const Vec3 spoke = body.vertices()[v] - graph.origin();
      std::vector<std::uint32_t> holding;
      for (std::uint32_t f = 0; f < graph.size(); ++f) {
        if (std::abs(graph.row(f).gauge(spoke) - 1) < 1e-9) holding.push_back(f);
      }
      const auto fan = graph.faces_about(v);
      ASSERT_GE(fan.size(), 3U);
      std::vector<std::uint32_t> sorted(fan.begin(), fan.end());
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(sorted, holding) << name;
      for (std::size_t i = 0; i < fan.size(); ++i) {  // counter-clockwise from outside
        const Vec3 p = graph.row(fan[i]).normal();
        const Vec3 q = graph.row(fan[(i + 1) % fan.size()]).normal();
        const Vec3 r = graph.row(fan[(i + 2) % fan.size()]).normal();
        EXPECT_GT(dot(cross(q - p, r - q), spoke), 0) << name;
      }
    }
  }
}

}  // namespace
}  // namespace carpus::convex
