// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All algorithms give the same polytope, up to which of several duplicates is named.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/rng.hpp"
#include "hull/brute_force_hull.hpp"
#include "hull/detail/hull_verification.hpp"
#include "hull/gift_wrapping.hpp"
#include "hull/hybrid_hull.hpp"
#include "hull/quickhull.hpp"

namespace carpus::hull {
namespace {

std::vector<Vec3> sorted_vertices(const HullResult& result) {
  std::vector<Vec3> v = result.polytope.vertices;
  std::sort(v.begin(), v.end(), [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  return v;
}

/// Lattices with duplicates, slivers, points on spheres, edges and faces, and general ones.
std::vector<Vec3> random_points(std::uint64_t seed, std::uint64_t most) {
  Rng rng(seed);
  const std::uint64_t kind = rng.below(6);
  std::vector<Vec3> points;
  for (std::uint64_t i = 4 + rng.below(most); i > 0; --i) {
    Vec3 p{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const auto lattice = [&](std::uint64_t n) { return static_cast<double>(rng.below(n)); };
    if (kind == 0) p = {lattice(3), lattice(3), lattice(2)};
    if (kind == 1) p = {0.3 * lattice(5) + 0.1, 0.7 * lattice(4), 0.9 * lattice(3)};
    if (kind == 2) p = normalized_or(p, {1, 0, 0});
    if (kind == 3) p = {lattice(4), lattice(4), (lattice(4) + p.x) * 1e-14};
    if (kind == 4 && points.size() > 3) {
      p = (points[rng.below(points.size())] + points[rng.below(points.size())]) * 0.5;
    }
    points.push_back(p);
  }
  return points;
}

using Algorithm = HullResult (*)(std::span<const Vec3>, const HullOptions&);

void expect_same(Algorithm algorithm, const std::vector<Vec3>& points, std::uint64_t seed) {
  const HullResult expected = build_convex_hull(points);
  const HullResult found = algorithm(points, {});
  ASSERT_EQ(found.status, expected.status) << "seed " << seed;
  ASSERT_EQ(sorted_vertices(found), sorted_vertices(expected)) << "seed " << seed;
  ASSERT_EQ(found.polytope.facets.size(), expected.polytope.facets.size()) << "seed " << seed;
  if (found.status == HullStatus::Ok) {
    ASSERT_EQ(verify_hull(found.polytope, points), "") << "seed " << seed;
  }
}

TEST(HullAlgorithms, BruteForceAgreesWithQuickhull) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    expect_same(build_hull_by_brute_force, random_points(seed, 14), seed);
  }
}

TEST(HullAlgorithms, GiftWrappingAgreesWithQuickhull) {
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    expect_same(build_hull_by_gift_wrapping, random_points(seed, 80), seed);
  }
}

TEST(HullAlgorithms, TheHybridAgreesWithQuickhull) {
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    expect_same(build_hull_by_hybrid, random_points(seed, 80), seed);
  }
}

TEST(HullAlgorithms, TheHybridDiscardsTheInsideOfABall) {
  Rng rng(1);
  std::vector<Vec3> points;
  while (points.size() < 4000) {
    const Vec3 p{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (squared_length(p) < 1) points.push_back(p);
  }
  const HullResult hybrid = build_hull_by_hybrid(points);
  const HullResult wrapped = build_hull_by_gift_wrapping(points);
  EXPECT_EQ(hybrid.polytope.facets, wrapped.polytope.facets);
  EXPECT_EQ(hybrid.polytope.vertices, wrapped.polytope.vertices);
  EXPECT_EQ(wrapped.statistics.points_discarded, 0U);
  // A triangle of base 2 and height 1 with an apex at 1 on both sides: 2/3 of 4 pi / 3.
  EXPECT_NEAR(static_cast<double>(hybrid.statistics.points_discarded) / 4000, 0.159, 0.03);
  EXPECT_LT(hybrid.statistics.orientation_tests, wrapped.statistics.orientation_tests);
}

TEST(HullAlgorithms, NameInputWithoutAHullAlike) {
  const std::vector<std::vector<Vec3>> inputs{
      {},
      std::vector<Vec3>(9, Vec3{1, 2, 3}),
      {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}},
      {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {5, 5, 1}},
  };
  for (const auto& points : inputs) {
    for (const Algorithm algorithm :
         {build_hull_by_brute_force, build_hull_by_gift_wrapping, build_hull_by_hybrid}) {
      expect_same(algorithm, points, 0);
    }
  }
}

}  // namespace
}  // namespace carpus::hull
