// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/allocation_test_support.hpp"
#include "survey/closest/detail/checks.hpp"
#include "survey/closest/epa.hpp"

namespace carpus::survey {
namespace {

constexpr double kToleranceMm = 1e-9;

/// Warm after another pose, then cold.
void judge_query(const test::Judge& judge, convex::PairQuery& query, const convex::PairPose& pose) {
  convex::PairPose near = pose;
  near.translation += {0.03, -0.02, 0.01};
  (void)query.penetration(near);
  judge.expect_penetration(query.penetration(pose));
  const convex::Verdict verdict = query.meets(pose);
  judge.expect_verdict(verdict);
  EXPECT_NE(verdict, convex::Verdict::Unknown);
  query.forget();
  judge.expect_penetration(query.penetration(pose));
}

TEST(DepthExact, AgreesWithTheOracleOnAllSolids) {
  Rng rng(41);
  const auto& solids = test::small_solids();
  for (std::uint64_t i = 0; i < test::cases(600); ++i) {
    const test::Solid& first = solids[rng.below(solids.size())];
    const test::Solid& second = solids[rng.below(solids.size())];
    const convex::PairPose pose =
        test::random_pose(rng, 2);  // most meet, many are nested or concentric
    SCOPED_TRACE(first.name + " on " + second.name + ", case " + std::to_string(i));
    const test::Judge judge(first.body, second.body, pose, kToleranceMm);
    DepthExact query(first.body, second.body);
    judge_query(judge, query, pose);
    // The fallback alone.
    const PosedPair pair(first.body.derived<convex::SupportGraph>(),
                         second.body.derived<convex::SupportGraph>(), pose);
    const double height = lowest_facet(pair, first.body, second.body, {}).height_mm;
    EXPECT_EQ(height < -kToleranceMm, judge.is_apart());
    if (!judge.is_apart()) {
      EXPECT_NEAR(height, judge.depth_mm(), kToleranceMm);
    }
  }
}

TEST(DepthExact, IsExactWhereAllFacetsTie) {
  Rng rng(42);
  const convex::ConvexBody ball = test::body_of(test::lattice_ball_points(3));
  const convex::ConvexBody prism = test::body_of(test::prism_points(24, 3, 3));
  for (const convex::ConvexBody* second : {&ball, &prism}) {
    for (const Vec3& offset : {Vec3{}, Vec3{1e-13, 0, 0}, Vec3{0.25, 0, 0}}) {
      const convex::PairPose pose{test::lattice_rotation(rng), offset};
      const test::Judge judge(ball, *second, pose, kToleranceMm);
      DepthExact query(ball, *second);
      judge_query(judge, query, pose);
    }
  }
}

TEST(DepthExact, GoesThroughAllFacetsWhereThePolytopeIsFull) {
  Rng rng(43);
  const convex::ConvexBody round = test::body_of(test::round_points(rng, 400, {10, 10, 10}));
  const convex::ConvexBody small = test::body_of(test::round_points(rng, 300, {6, 6, 6}));
  DepthExact query(round, small);
  const convex::PairPose concentric{test::random_rotation(rng), {}};
  const PosedPair pair(round.derived<convex::SupportGraph>(), small.derived<convex::SupportGraph>(),
                       concentric);
  const auto answer = query.penetration(concentric);
  ASSERT_TRUE(answer.has_value());
  EXPECT_NEAR(answer.value_or(convex::Penetration{}).depth_mm,
              lowest_facet(pair, round, small, {}).height_mm, kToleranceMm);
  EXPECT_EQ(query.counts().enumerated, 1U);
}

/// At the answer's end the bodies touch; a thousandth before they meet.
void expect_parts(const convex::ConvexBody& first,
                  const convex::ConvexBody& second,
                  const convex::PairPose& pose,
                  const convex::Penetration& answer) {
  const auto moved = [&](double share) {
    convex::PairPose result = pose;
    result.translation += answer.direction * (answer.depth_mm * share);
    return result;
  };
  Gjk query(first, second, ClimbStart::Table);
  EXPECT_EQ(query.meets(moved(0.999)), convex::Verdict::Meet);
  EXPECT_EQ(query.meets(moved(1.0 + 1e-9 / answer.depth_mm)), convex::Verdict::Apart);
}

TEST(DepthExact, PartsRoundBodiesOnACourseWarmAsCold) {
  Rng rng(44);
  const convex::ConvexBody first = test::body_of(test::round_points(rng, 300, {20, 12, 10}));
  const convex::ConvexBody second = test::body_of(test::round_points(rng, 200, {8, 9, 15}));
  DepthExact warm(first, second);
  DepthExact cold(first, second);
  std::uint64_t meeting = 0;
  for (std::uint64_t i = 0; i < test::cases(2000); ++i) {
    const convex::PairPose pose = test::pose_on_a_course(0.01 * static_cast<double>(i), 18);
    cold.forget();
    const auto a = cold.penetration(pose);
    const auto b = warm.penetration(pose);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a || !b) continue;
    ++meeting;
    EXPECT_NEAR(a->depth_mm, b->depth_mm, 1e-10);
    if (b->depth_mm > 1e-3) expect_parts(first, second, pose, *b);
  }
  EXPECT_GT(meeting, 0U);
  EXPECT_EQ(cold.counts().enumerated, 0U);
  EXPECT_GT(warm.counts().warm, meeting / 2);
  EXPECT_LT(warm.counts().growths, cold.counts().growths / 4);
}

TEST(DepthExact, IsSymmetricAndExactFarFromTheOrigin) {
  Rng rng(45);
  const auto& solids = test::small_solids();
  const Vec3 far{1e6, -7e5, 3e5};
  for (const test::Solid& solid : solids) {
    SCOPED_TRACE(solid.name);
    const convex::ConvexBody first = test::shifted(solid.body, far);
    const convex::ConvexBody second = test::shifted(solids[4].body, -far);
    for (std::uint64_t i = 0; i < test::cases(10); ++i) {
      convex::PairPose pose{test::random_rotation(rng), test::random_direction(rng)};
      pose.translation += far + pose.rotation * far;
      const test::Judge judge(first, second, pose, kToleranceMm);
      if (!judge.is_meeting()) continue;
      DepthExact query(first, second);
      const auto answer = query.penetration(pose);
      ASSERT_TRUE(answer.has_value());
      EXPECT_NEAR(answer.value_or(convex::Penetration{}).depth_mm, judge.depth_mm(), kToleranceMm);
      // The inverse of a pose that far off is rounded to 1e-10 mm.
      const auto inverse = pose.inverse();
      DepthExact swapped(second, first);
      const auto other = swapped.penetration({inverse.rotation, inverse.translation});
      EXPECT_NEAR(other.value_or(convex::Penetration{}).depth_mm, judge.depth_mm(), 1e-8);
    }
  }
}

TEST(DepthExact, FindsTheDepthOfBoxes) {
  const convex::ConvexBody body = test::body_of(test::box_points({1, 1, 1}));
  DepthExact query(body, body);
  const auto at = [&](const Vec3& t) {
    return query.penetration({Mat3::identity(), t}).value_or(convex::Penetration{-1, {}, {}, {}});
  };
  EXPECT_DOUBLE_EQ(at({}).depth_mm, 2);
  EXPECT_DOUBLE_EQ(at({1.5, 0.25, 0}).depth_mm, 0.5);
  EXPECT_EQ(at({1.5, 0.25, 0}).direction, (Vec3{1, 0, 0}));
  EXPECT_NEAR(at({2, 0, 0}).depth_mm, 0, 1e-15);  // touching
  EXPECT_EQ(at({2.0000001, 0, 0}).depth_mm, -1);
}

TEST(DepthExact, DoesNotAllocateInAQuery) {
  const convex::ConvexBody body = test::body_of(test::lattice_ball_points(5));
  DepthExact query(body, body);
  Epa epa(body, body);
  Rng rng(46);
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 200; ++i) {
    const convex::PairPose pose = test::random_pose(rng, 6);
    (void)query.penetration(pose);
    (void)epa.penetration(pose);
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

TEST(DepthExact, GivesNoAnswerForAPoseThatIsNotANumber) {
  const convex::ConvexBody body = test::body_of(test::box_points({1, 1, 1}));
  DepthExact query(body, body);
  EXPECT_TRUE(query.penetration({}).has_value());
  convex::PairPose pose;
  pose.translation.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(query.meets(pose), convex::Verdict::Unknown);
  EXPECT_FALSE(query.penetration(pose).has_value());
  EXPECT_TRUE(query.penetration({}).has_value());
}

TEST(Epa, ComesNearTheDepth) {
  Rng rng(47);
  const auto& solids = test::small_solids();
  for (std::uint64_t i = 0; i < test::cases(200); ++i) {
    const convex::ConvexBody& first = solids[rng.below(solids.size())].body;
    const convex::ConvexBody& second = solids[rng.below(solids.size())].body;
    const convex::PairPose pose{test::random_rotation(rng), test::random_direction(rng)};
    Epa query(first, second);
    DepthExact exact(first, second);
    const auto a = query.penetration(pose);
    const auto b = exact.penetration(pose);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a || !b) continue;
    EXPECT_GE(a->depth_mm, b->depth_mm - kToleranceMm);
    EXPECT_LE(a->depth_mm, b->depth_mm + 1e-5);
  }
}

}  // namespace
}  // namespace carpus::survey
