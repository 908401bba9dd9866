// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All algorithms on many seeded point sets, most of them degenerate. Each result is verified by
// detail/hull_verification.hpp, which knows nothing of how it was made (or is equal, in every
// corner and facet, to one that was). CARPUS_LONG=1 runs 100 000 sets instead of 2000.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "hull/detail/all_algorithms.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/detail/face_polygon.hpp"
#include "hull/merged_faces.hpp"

namespace carpus::hull {
namespace {

std::uint64_t case_count() { return carpus::test::amount<std::uint64_t>(2000, 2000, 100'000); }

/// Points of one plane, of one line, one point many times, few points.
std::vector<Vec3> flat_points(Rng& rng) {
  const std::uint64_t kind = rng.below(5);
  std::vector<Vec3> points;
  for (std::uint64_t i = rng.below(40); i > 0; --i) {
    const double a = static_cast<double>(rng.below(20)) - 9;
    const double b = static_cast<double>(rng.below(20)) - 9;
    Vec3 p{a, b, a + 2 * b};
    if (kind == 1) p = {rng.uniform(-1, 1), rng.uniform(-1, 1), 0.7};
    if (kind == 2) p = {a, 3 * a, -5 * a};
    if (kind == 3) p = {0.1, 0.2, 0.3};
    if (kind == 4 && i == 1) p.z += 1;  // one point off the plane
    points.push_back(p);
  }
  return points;
}

std::vector<Vec3> points_of_case(std::uint64_t seed) {
  Rng rng(seed + 0x9000'0000);
  if (seed % 10 == 9) return flat_points(rng);
  std::vector<Vec3> points = random_points(seed);
  if (seed % 10 == 8) {
    const std::array factors{1e95, 1e-75, 0.1, 7e3};
    const double factor = factors[rng.below(factors.size())];
    for (Vec3& p : points) p *= factor;
  }
  if (seed % 10 == 7) {  // far from the origin: coordinates lose bits, points fall together
    for (Vec3& p : points) p += {1e6, -3e7, 2e15};
  }
  if (seed % 3 == 0) points.resize(std::min<std::size_t>(points.size(), 4 + rng.below(12)));
  return points;
}

TEST(HullProperties, HoldForEveryAlgorithmOnManySeeds) {
  std::uint64_t hulls = 0;
  const std::uint64_t count = case_count();
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const std::vector<Vec3> points = points_of_case(seed);
    std::vector<Vec3> distinct;
    for (const std::uint32_t i : distinct_points(points)) distinct.push_back(points[i]);
    const bool use_distinct = seed % 2 == 0;
    ASSERT_EQ(check_all(use_distinct ? distinct : points, distinct.size() < points.size()), "")
        << "seed " << seed;
    hulls += status_of(points) == HullStatus::Ok ? 1 : 0;
  }
  EXPECT_GT(hulls, count / 2);
  EXPECT_LT(hulls, count);  // inputs without a hull are among them
}

std::vector<Vec3> corners_sorted(const HullResult& hull) {
  std::vector<Vec3> v = hull.polytope.vertices;
  std::sort(v.begin(), v.end(), [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  return v;
}

TEST(HullProperties, DoNotDependOnOrderDuplicationSignsOrAxes) {
  const std::uint64_t count = case_count() / 10;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const std::vector<Vec3> points = points_of_case(seed);
    std::vector<Vec3> moved = points;
    Rng rng(seed);
    for (std::size_t i = 0; i < points.size(); i += 3) moved.push_back(points[i]);
    for (std::size_t i = moved.size(); i > 1; --i) std::swap(moved[i - 1], moved[rng.below(i)]);
    // An exact rotation: a cyclic change of axes, and two signs.
    const auto rotated = [](const Vec3& p) { return Vec3{-p.y, p.z, -p.x}; };
    std::transform(moved.begin(), moved.end(), moved.begin(), rotated);
    for (const Algorithm& algorithm : kAlgorithms) {
      if (moved.size() > algorithm.most_points) continue;
      HullResult expected = algorithm.build(points, {});
      const HullResult found = algorithm.build(moved, {});
      if (points.size() < 4) continue;  // duplication changes the number
      ASSERT_EQ(found.status, expected.status) << algorithm.name << " seed " << seed;
      auto& v = expected.polytope.vertices;
      std::transform(v.begin(), v.end(), v.begin(), rotated);
      ASSERT_EQ(corners_sorted(found), corners_sorted(expected)) << algorithm.name << " " << seed;
      const HullResult again = algorithm.build(found.polytope.vertices, {});
      if (found.status != HullStatus::Ok) continue;
      ASSERT_EQ(again.polytope.facets, found.polytope.facets) << algorithm.name << " " << seed;
    }
  }
}

/// Whole numbers turn and move without rounding under 27 times a rotation about a skew axis.
TEST(HullProperties, DoNotDependOnRigidMotion) {
  const std::uint64_t count = case_count() / 10;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Rng rng(seed + 77);
    const auto whole = [&] { return static_cast<double>(rng.below(24)) - 12; };
    std::vector<Vec3> points;
    for (std::uint64_t i = 8 + rng.below(60); i > 0; --i) {
      const double x = whole();
      const double y = whole();
      points.push_back({x, y, whole()});
    }
    const Vec3 shift{whole() * 1e3, whole() * 1e6, whole()};
    const auto moved_point = [&](const Vec3& p) {
      const auto ninth = [](const Vec3& v) {  // 9 R, R a rotation by the quaternion (2, 2, 1, 0)
        return Vec3{7 * v.x + 4 * v.y + 4 * v.z, 4 * v.x + v.y - 8 * v.z, -4 * v.x + 8 * v.y - v.z};
      };
      return ninth(p) * 3 + shift;
    };
    std::vector<Vec3> moved;
    for (const Vec3& p : points) moved.push_back(moved_point(p));
    for (const Algorithm& algorithm : kAlgorithms) {
      if (points.size() > algorithm.most_points) continue;
      HullResult before = algorithm.build(points, {});
      const HullResult after = algorithm.build(moved, {});
      ASSERT_EQ(after.status, before.status) << algorithm.name << " " << seed;
      const std::size_t faces = merged_faces(before.polytope).size();
      auto& v = before.polytope.vertices;
      std::transform(v.begin(), v.end(), v.begin(), moved_point);
      ASSERT_EQ(corners_sorted(after), corners_sorted(before)) << algorithm.name << " " << seed;
      ASSERT_EQ(merged_faces(after.polytope).size(), faces) << algorithm.name << " " << seed;
    }
  }
}

}  // namespace
}  // namespace carpus::hull
