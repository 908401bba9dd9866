// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/detail/facet_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/rng.hpp"

namespace carpus::fields {
namespace {

constexpr std::uint32_t kNone = NearestFacet::kNone;
constexpr double kFarthestMm = 30;
/// All of any mesh here is within reach of any point.
constexpr double kNoLimitMm = 1000;

Vec3 random_point(Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-reach, reach)};
}

/// What a facet can be: of any shape, a sliver, a line, a point, a corner used twice, one in the
/// place of another, or a twin with the other side out.
TriangleMesh random_facets(Rng& rng, const Vec3& place) {
  TriangleMesh mesh;
  const std::size_t count = 1 + rng.below(40);
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& p : {a, b, c}) mesh.vertices.push_back(p);
    mesh.facets.push_back({first, first + 1, first + 2});
  };
  while (mesh.facets.size() < count) {
    const Vec3 a = place + random_point(rng, 8);
    const double size = std::pow(10.0, rng.uniform(-3, 1));
    const Vec3 b = a + random_point(rng, size);
    const Vec3 c = a + random_point(rng, size);
    switch (rng.below(8)) {
      case 0:
        add(a, b, a + (b - a) * 0.3 + random_point(rng, size * 1e-7));
        break;
      case 1:
        add(a, b, a + (b - a) * rng.uniform(-1, 2));
        break;
      case 2:
        add(a, a, a);
        break;
      case 3:
        add(a, b, b);
        break;
      case 4:
        mesh.facets.push_back(mesh.facets.empty() ? Triangle{0, 0, 0} : mesh.facets.back());
        if (mesh.vertices.empty()) mesh.vertices.push_back(a);
        break;
      case 5:
        add(a, b, c);
        add(b, a, c);
        break;
      default:
        add(a, b, c);
    }
  }
  return mesh;
}

/// Of all facets, by the same exact-to-rounding function of one facet that answers come from.
double least_squared(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    least = std::min(least, nearest_on(mesh, f, p).squared_distance);
  }
  return least;
}

Vec3 random_place(Rng& rng) {
  // A scan's origin may be far from zero, where single precision is coarse.
  return rng.below(2) == 0 ? Vec3{} : random_point(rng, 500);
}

TEST(FacetDiscs, FindTheNearestOfAllFacets) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Rng rng(seed);
    const Vec3 place = random_place(rng);
    const TriangleMesh mesh = random_facets(rng, place);
    FacetDiscs discs(mesh, kFarthestMm);
    ASSERT_EQ(discs.size(), mesh.facets.size());
    for (int k = 0; k < 20; ++k) {
      // Away from the facets, near them, and on them.
      Vec3 p = place + random_point(rng, 20);
      if (k % 2 == 0) p = mesh.vertices[rng.below(mesh.vertices.size())] + random_point(rng, 0.1);
      if (k % 5 == 0) p = mesh.vertices[rng.below(mesh.vertices.size())];
      const double least = least_squared(mesh, p);
      const auto hint =
          rng.below(2) == 0 ? kNone : static_cast<std::uint32_t>(rng.below(mesh.facets.size()));
      const NearestFacet found = discs.nearest(p, kNoLimitMm, hint);
      ASSERT_NE(found.facet, kNone);
      EXPECT_EQ(found.squared_distance, least) << "seed " << seed;
      EXPECT_EQ(nearest_on(mesh, found.facet, p).squared_distance, least);
    }
  }
}

TEST(FacetDiscs, BeyondTheLimitThereIsNone) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const TriangleMesh mesh = random_facets(rng, {});
    FacetDiscs discs(mesh, kFarthestMm);
    const Vec3 p = random_point(rng, 20);
    const double least_mm = std::sqrt(least_squared(mesh, p));
    EXPECT_EQ(discs.nearest(p, 0.999 * least_mm, kNone).facet, kNone);
    if (least_mm > 0) {
      EXPECT_NE(discs.nearest(p, 1.001 * least_mm, kNone).facet, kNone);
    }
  }
}

/// Where a ball's facets were handed on, and those of a ball within it once more, each point of the
/// inner ball still finds the nearest of all.
TEST(FacetDiscs, WhatABallKeepsHoldsTheNearestToEachOfItsPoints) {
  std::size_t left_out = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Rng rng(seed);
    const Vec3 place = random_place(rng);
    const TriangleMesh mesh = random_facets(rng, place);
    FacetDiscs all(mesh, kFarthestMm);
    FacetDiscs outer = all;
    FacetDiscs inner = all;
    const double limit_mm = rng.below(3) == 0 ? rng.uniform(0.5, 8) : kNoLimitMm;
    FacetBall ball{place + random_point(rng, 15), rng.uniform(0.01, 6), {}};
    ball.near =
        nearest_on(mesh, static_cast<std::uint32_t>(rng.below(mesh.facets.size())), ball.centre);
    if (rng.below(2) == 0) ball.near = all.nearest(ball.centre, kNoLimitMm, kNone);
    const std::uint32_t seems = all.keep_nearest_in(ball, limit_mm, outer);
    EXPECT_EQ(seems == kNone, outer.size() == 0);
    FacetBall part{ball.centre, 0.5 * ball.radius, {}};
    part.centre = ball.centre + normalized_or(random_point(rng, 1), {1, 0, 0}) * part.radius;
    part.near = nearest_on(mesh, seems == kNone ? ball.near.facet : seems, part.centre);
    (void)outer.keep_nearest_in(part, limit_mm, inner);
    EXPECT_LE(inner.size(), outer.size());
    left_out += mesh.facets.size() - inner.size();
    for (int k = 0; k < 20; ++k) {
      const double reach = k % 2 == 0 ? part.radius : rng.uniform(0, part.radius);
      const Vec3 p = part.centre + normalized_or(random_point(rng, 1), {0, 1, 0}) * reach;
      const double least = least_squared(mesh, p);
      // At the limit itself rounding may decide.
      if (std::abs(std::sqrt(least) - limit_mm) < 1e-9) continue;
      const NearestFacet found = inner.nearest(p, limit_mm, kNone);
      if (std::sqrt(least) > limit_mm) {
        EXPECT_EQ(found.facet, kNone) << "seed " << seed;
      } else {
        EXPECT_EQ(found.squared_distance, least) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(left_out, 2000U);  // else it proves nothing
}

TEST(FacetDiscs, OfNoFacetsFindNone) {
  const TriangleMesh empty;
  FacetDiscs discs(empty, kFarthestMm);
  EXPECT_EQ(discs.nearest({1, 2, 3}, kNoLimitMm, kNone).facet, kNone);
}

}  // namespace
}  // namespace carpus::fields
