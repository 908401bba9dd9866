// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/hull_hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/detail/large_points.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::hull {
namespace {

const Vec3 kExtent{1e3, 1e3, 1e3};

/// No vertex above the plane of the answer, and add_face finds all vertices in it.
void expect_touch(const HullHierarchy& hierarchy, const TurningLine& line, FaceSearch& search) {
  const ConvexPolytope& hull = hierarchy.polytope();
  HullStatistics statistics;
  const std::uint32_t w = hierarchy.touch(line, statistics);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
    const int side = orient3d(line.a, line.b, hull.vertices[w], hull.vertices[v]);
    ASSERT_LE(side, 0);
    if (side == 0) expected.push_back(hull.input_indices[v]);
  }
  std::vector<std::uint32_t> found;
  hierarchy.add_face(TurningPlane(line, hull.vertices[w]), w, search, found, statistics);
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found, expected);
}

/// Whether the facets beside the edge from corner `i` of a facet are in different planes.
bool is_edge(const ConvexPolytope& hull, std::uint32_t facet, std::size_t i) {
  const Triangle& t = hull.facets[facet];
  const Triangle& other = hull.facets[hull.neighbours[facet][i]];
  return std::any_of(other.begin(), other.end(), [&](std::uint32_t v) {
    return orient3d(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]],
                    hull.vertices[v]) != 0;
  });
}

/// Lines beyond a supporting plane; along edges; and through the last corner along an axis.
void expect_touches(const HullHierarchy& hierarchy, std::uint64_t seed, int queries) {
  const ConvexPolytope& hull = hierarchy.polytope();
  Rng rng(seed);
  FaceSearch search;
  for (int query = 0; query < queries; ++query) {
    const Vec3 up = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {0, 0, 1});
    const Vec3 far = up * 200.0;
    expect_touch(hierarchy, {far, far + any_perpendicular(up), kExtent}, search);
    const auto f = static_cast<std::uint32_t>(rng.below(hull.facets.size()));
    const std::size_t i = rng.below(3);
    if (is_edge(hull, f, i)) {
      const Vec3& a = hull.vertices[hull.facets[f][i]];
      const Vec3& b = hull.vertices[hull.facets[f][(i + 1) % 3]];
      expect_touch(hierarchy, {a, b, kExtent}, search);
      expect_touch(hierarchy, {b, a, kExtent}, search);
    }
    const double sign = rng.below(2) == 0 ? 1 : -1;
    const Vec3 last = *std::max_element(hull.vertices.begin(), hull.vertices.end(),
                                        [&](const Vec3& a, const Vec3& b) {
                                          for (std::size_t k = i; k < i + 3; ++k) {
                                            if (a[k % 3] != b[k % 3])
                                              return sign * a[k % 3] < sign * b[k % 3];
                                          }
                                          return false;
                                        });
    Vec3 beside = last;
    beside[(i + 2) % 3] += rng.below(2) == 0 ? 1 : -1;
    expect_touch(hierarchy, {last, beside, kExtent}, search);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(HullHierarchy, TouchesWhereALinearSearchWould) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const HullResult hull = build_fast_hull(large_points(seed, 6000));
    ASSERT_EQ(hull.status, HullStatus::Ok);
    expect_touches(HullHierarchy(hull.polytope), seed, 50);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

TEST(HullHierarchy, TouchesThereTooWhereAllRingsAreSearched) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const HullResult hull =
        build_fast_hull(seed % 8 == 0 ? large_points(seed / 8, 1000) : random_points(seed));
    if (hull.status != HullStatus::Ok) continue;
    expect_touches(HullHierarchy(hull.polytope, 0), seed, 20);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

/// Orientation tests of 2000 touches.
std::uint64_t tests_of_touches(const HullHierarchy& hierarchy) {
  Rng rng(5);
  HullStatistics statistics;
  for (int query = 0; query < 2000; ++query) {
    const Vec3 up = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {0, 0, 1});
    static_cast<void>(
        hierarchy.touch({up * 2.0, up * 2.0 + any_perpendicular(up), kExtent}, statistics));
  }
  return statistics.orientation_tests;
}

TEST(HullHierarchy, AsksFewVerticesOfALargeHull) {
  Rng rng(3);
  std::vector<Vec3> points(20'000);
  for (Vec3& p : points) {
    p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
  }
  // About 14 doublings; a linear search would ask 20 000.
  EXPECT_LT(tests_of_touches(HullHierarchy(build_fast_hull(points).polytope)), 2000U * 150U);
}

TEST(HullHierarchy, AsksFewVerticesThoughAllAreJoinedToTwo) {
  std::vector<std::uint64_t> tests;
  for (const std::size_t count : {std::size_t{4000}, std::size_t{16'000}}) {
    const HullHierarchy hierarchy(build_fast_hull(wheel(count)).polytope);
    tests.push_back(tests_of_touches(hierarchy));
    expect_touches(hierarchy, count, 10);
  }
  EXPECT_LT(tests[0], 2000U * 50U);
  EXPECT_LT(tests[1], tests[0] * 3 / 2);  // for four times the points
}

}  // namespace
}  // namespace carpus::hull
