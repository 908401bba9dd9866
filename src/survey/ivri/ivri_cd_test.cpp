// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Examples and limits; tests/oracles/ivri_oracle_test.cpp compares thousands of pairs with an exact
// oracle.
#include "survey/ivri/ivri_cd.hpp"
#include "survey/methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::survey {
namespace {

std::vector<Vec3> box(const Vec3& half) {
  std::vector<Vec3> corners(8);
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? half.x : -half.x, (i & 2U) != 0 ? half.y : -half.y,
                  (i & 4U) != 0 ? half.z : -half.z};
  }
  return corners;
}

convex::PairPose moved(const Vec3& translation) { return {Mat3::identity(), translation}; }

/// A bumpy surface: most of its points lie inside the hull.
std::vector<Vec3> surface(Rng& rng, std::size_t count) {
  std::vector<Vec3> points(count);
  for (Vec3& point : points) {
    const Vec3 p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
    point = Vec3{9 * p.x, 6 * p.y, 5 * p.z} * rng.uniform(0.9, 1.0);
  }
  return points;
}

TEST(IvriCd, DrawsTwoPointsOfTheBodiesTogetherAlongOneLine) {
  IvriCd ivri(box({1, 1, 1}), box({1, 1, 1}));
  const IvriAnswer apart = ivri.query(moved({5, 0.5, 0.25}));
  EXPECT_EQ(apart.status, IvriStatus::Apart);
  EXPECT_NEAR(apart.on_first.x, 1, 1e-12);
  EXPECT_NEAR(apart.on_second.x, 4, 1e-12);
  const Vec3 left = apart.on_second - apart.on_first;  // phi u
  EXPECT_NEAR(apart.residual_mm, std::max({left.x, std::abs(left.y), std::abs(left.z)}), 1e-12);
  EXPECT_GE(length(left), 3.0);  // an upper bound of the distance
}

TEST(IvriCd, FindsACommonPointOfBodiesThatMeet) {
  IvriCd ivri(box({1, 1, 1}), box({1, 1, 1}));
  const IvriAnswer meet = ivri.query(moved({1.5, 0.5, -1.25}));
  EXPECT_EQ(meet.status, IvriStatus::Meet);
  EXPECT_LE(distance(meet.on_first, meet.on_second), 1e-12);
  const Aabb first = bounds_of(box({1, 1, 1})).grown(1e-12);
  EXPECT_TRUE(first.contains(meet.on_first));
  EXPECT_TRUE(first.contains(meet.on_first - Vec3{1.5, 0.5, -1.25}));
}

TEST(IvriCd, CountsTouchingNestedAndEqualBodiesAsMeeting) {
  IvriCd ivri(box({1, 1, 1}), box({1, 1, 1}));
  EXPECT_EQ(ivri.query(moved({2, 0, 0})).status, IvriStatus::Meet);  // faces
  EXPECT_EQ(ivri.query(moved({2, 2, 0})).status, IvriStatus::Meet);  // edges
  EXPECT_EQ(ivri.query(moved({2, 2, 2})).status, IvriStatus::Meet);  // corners
  EXPECT_EQ(ivri.query(moved({2, 2, 2.001})).status, IvriStatus::Apart);
  EXPECT_EQ(ivri.query(moved({0, 0, 0})).status, IvriStatus::Meet);
  IvriCd nested(box({5, 5, 5}), box({1, 1, 1}));
  EXPECT_EQ(nested.query(moved({0.5, 0, 0})).status, IvriStatus::Meet);
}

TEST(IvriCd, AnswersTheSameOnAllVerticesAsOnThoseOfTheHull) {
  Rng rng(7);
  const std::vector<Vec3> a = surface(rng, 1500);
  const std::vector<Vec3> b = surface(rng, 1200);
  const auto hull_a = hull::build_fast_hull(a).polytope.vertices;
  const auto hull_b = hull::build_fast_hull(b).polytope.vertices;
  EXPECT_LT(hull_a.size(), a.size() / 2);
  IvriCd whole(a, b);
  IvriCd hulls(hull_a, hull_b);
  int meet = 0;
  for (int i = 0; i < 300; ++i) {
    convex::PairPose pose{rotation_about({0, 0, 1}, rng.uniform(0, 6)), {}};
    pose.translation = {rng.uniform(-16, 16), rng.uniform(-10, 10), rng.uniform(-8, 8)};
    const IvriAnswer of_whole = whole.query(pose);
    ASSERT_EQ(of_whole.status, hulls.query(pose).status) << i;
    meet += of_whole.status == IvriStatus::Meet ? 1 : 0;
  }
  EXPECT_GT(meet, 60);
  EXPECT_LT(meet, 240);
  EXPECT_GT(whole.statistics().warm_starts, 50U);
  EXPECT_EQ(whole.statistics().pivot_limits, 0U);
}

TEST(IvriCd, AnswersColdAsItAnswersWarm) {
  Rng rng(9);
  const std::vector<Vec3> a = surface(rng, 200);
  IvriCd warm(a, a);
  IvriCd cold(a, a);
  convex::PairPose pose = moved({14, 3, 2});
  for (int i = 0; i < 400; ++i) {
    pose.rotation = rotation_about({0.6, 0, 0.8}, 0.01) * pose.rotation;
    pose.translation += Vec3{rng.normal(), rng.normal(), rng.normal()} * 0.3;
    if (length(pose.translation) > 16) pose.translation *= 0.9;
    cold.forget();
    ASSERT_EQ(warm.query(pose).status, cold.query(pose).status) << i;
  }
  EXPECT_LT(warm.statistics().pivots, cold.statistics().pivots / 2);
}

TEST(IvriCd, TakesBodiesNearerThanEpsilonForTouching) {
  IvriCd ivri(box({1, 1, 1}), box({1, 1, 1}));
  EXPECT_EQ(ivri.query(moved({2 + 5e-10, 0, 0})).status, IvriStatus::Meet);  // apart in truth
  EXPECT_EQ(ivri.query(moved({2 + 5e-9, 0, 0})).status, IvriStatus::Apart);
  IvriCd coarse(box({1, 1, 1}), box({1, 1, 1}), 0.1);
  EXPECT_EQ(coarse.query(moved({2.05, 0, 0})).status, IvriStatus::Meet);
  EXPECT_EQ(coarse.query(moved({2.15, 0, 0})).status, IvriStatus::Apart);
}

TEST(IvriCd, AnswersNothingForAPoseThatIsNotFinite) {
  IvriCd ivri(box({1, 1, 1}), box({1, 1, 1}));
  EXPECT_EQ(ivri.query(moved({std::numeric_limits<double>::quiet_NaN(), 0, 0})).status,
            IvriStatus::NotFinite);
  convex::PairPose pose;
  pose.rotation.rows[1].y = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ivri.query(pose).status, IvriStatus::NotFinite);
  EXPECT_EQ(ivri.query(moved({})).status, IvriStatus::Meet);  // and recovers
}

TEST(IvriCd, RefusesWhatIsNoBody) {
  const std::vector<Vec3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(IvriCd(three, box({1, 1, 1})), InvalidInput);
  std::vector<Vec3> broken = box({1, 1, 1});
  broken[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(IvriCd(box({1, 1, 1}), broken), InvalidInput);
}

TEST(IvriCd, DoesNotAllocateInAQuery) {
  Rng rng(3);
  const convex::ConvexBody a(hull::build_fast_hull(surface(rng, 300)).polytope);
  const auto query = find_method("ivri")->make(a, a);
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 100; ++i) (void)query->meets(moved({0.1 * i + 5, 1, 2}));
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

}  // namespace
}  // namespace carpus::survey
