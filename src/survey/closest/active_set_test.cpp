// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/active_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/allocation_test_support.hpp"
#include "survey/closest/detail/checks.hpp"
#include "survey/closest/wide_nearest.hpp"

namespace carpus::survey {
namespace {

constexpr double kToleranceMm = 1e-9;

/// Twice: cold, and warm from another pose.
void judge_query(const test::Judge& judge, convex::PairQuery& query, const convex::PairPose& pose) {
  const convex::Verdict verdict = query.meets(pose);
  judge.expect_verdict(verdict);
  EXPECT_NE(verdict, convex::Verdict::Unknown);
  judge.expect_closest(query.closest(pose));
  convex::PairPose near = pose;
  near.translation += {0.03, -0.02, 0.01};
  (void)query.closest(near);
  judge.expect_closest(query.closest(pose));
  judge.expect_verdict(query.meets(pose));
}

TEST(ClosestActiveSet, AgreesWithTheOraclesOnAllSolids) {
  Rng rng(21);
  const auto& solids = test::small_solids();
  for (std::uint64_t i = 0; i < test::cases(600); ++i) {
    const test::Solid& first = solids[rng.below(solids.size())];
    const test::Solid& second = solids[rng.below(solids.size())];
    const convex::PairPose pose = test::random_pose(rng, 5);
    SCOPED_TRACE(first.name + " on " + second.name + ", case " + std::to_string(i));
    ClosestActiveSet query(first.body, second.body);
    judge_query({first.body, second.body, pose, kToleranceMm}, query, pose);
  }
}

TEST(ClosestActiveSet, IsExactFarFromTheOrigin) {
  Rng rng(22);
  const Vec3 far{1e6, -7e5, 3e5};
  for (const test::Solid& solid : test::small_solids()) {
    SCOPED_TRACE(solid.name);
    const convex::ConvexBody first = test::shifted(solid.body, far);
    const convex::ConvexBody second = test::shifted(test::small_solids()[0].body, -far);
    for (std::uint64_t i = 0; i < test::cases(20); ++i) {
      convex::PairPose pose = test::random_pose(rng, 4);
      pose.translation += far + pose.rotation * far;
      ClosestActiveSet query(first, second);
      const test::Judge judge(first, second, pose, kToleranceMm);
      judge.expect_verdict(query.meets(pose));
      // Points out there are known to 1e-10 mm only, planes to no more: distances are not.
      const std::optional<convex::Closest> answer = query.closest(pose);
      if (answer && judge.is_apart()) {
        EXPECT_NEAR(answer->distance_mm, judge.distance_mm(), kToleranceMm);
      }
    }
  }
}

TEST(ClosestActiveSet, AnswersWarmAsColdAndChangesNoFasterThanTheBodiesMove) {
  Rng rng(23);
  const convex::ConvexBody first = test::body_of(test::round_points(rng, 300, {20, 12, 10}));
  const convex::ConvexBody second = test::body_of(test::round_points(rng, 200, {8, 9, 15}));
  ClosestActiveSet warm(first, second);
  ClosestActiveSet cold(first, second);
  double last = std::numeric_limits<double>::quiet_NaN();
  convex::PairPose last_pose;
  for (std::uint64_t i = 0; i < test::cases(2000); ++i) {
    const convex::PairPose pose = test::pose_on_a_course(0.01 * static_cast<double>(i), 25);
    cold.forget();
    const auto a = cold.closest(pose);
    const auto b = warm.closest(pose);
    test::expect_same(a, b, a.has_value());
    double moved = 0;  // the most that a point of the second body has moved
    for (const Vec3& v : second.vertices()) {
      moved = std::max(moved, distance(pose.rotation * v + pose.translation,
                                       last_pose.rotation * v + last_pose.translation));
    }
    const double now = b ? b->distance_mm : 0;
    if (i > 0) {
      EXPECT_LE(std::abs(now - last), moved + 1e-11);
    }
    last = now;
    last_pose = pose;
  }
}

TEST(ClosestActiveSet, IsSymmetricAndKnowsNoFrame) {
  Rng rng(24);
  const auto& solids = test::small_solids();
  for (std::uint64_t i = 0; i < test::cases(1000); ++i) {
    const convex::ConvexBody& first = solids[rng.below(solids.size())].body;
    const convex::ConvexBody& second = solids[rng.below(solids.size())].body;
    const convex::PairPose pose{test::random_rotation(rng),
                                test::random_direction(rng) * rng.uniform(1, 9)};
    const auto inverse = pose.inverse();
    ClosestActiveSet query(first, second);
    ClosestActiveSet swapped(second, first);
    const auto a = query.closest(pose);
    const auto b = swapped.closest({inverse.rotation, inverse.translation});
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a || !b) continue;
    EXPECT_NEAR(a->distance_mm, b->distance_mm, 1e-12);
    EXPECT_LE(length(pose.rotation * b->normal + a->normal) * a->distance_mm, 1e-9);
  }
}

TEST(ClosestActiveSet, FindsTheDistanceOfBoxesInEveryRelation) {
  const convex::ConvexBody body = test::body_of(test::box_points({1, 1, 1}));
  ClosestActiveSet query(body, body);
  const auto at = [&](const Vec3& t) {
    return query.closest({Mat3::identity(), t}).value_or(convex::Closest{}).distance_mm;
  };
  EXPECT_DOUBLE_EQ(at({3, 0, 0}), 1);              // faces
  EXPECT_DOUBLE_EQ(at({4, 5, 0}), std::sqrt(13));  // edges
  EXPECT_DOUBLE_EQ(at({4, 5, 6}), std::sqrt(29));  // corners
  EXPECT_DOUBLE_EQ(at({2 + 0x1p-30, 0.5, 0}), 0x1p-30);
  EXPECT_EQ(at({2, 0, 0}), 0);  // touching is meeting
  EXPECT_EQ(query.meets({Mat3::identity(), {2, 2, 2}}), convex::Verdict::Meet);
  EXPECT_EQ(query.meets({Mat3::identity(), {2.0000001, 2, 2}}), convex::Verdict::Apart);
}

TEST(ClosestActiveSet, IsRightForBladesWhoseEdgesAreAllButParallelInBothPrecisions) {
  // The facet of the difference that two such edges span is a sliver.
  const convex::ConvexBody blade = test::body_of(test::box_points({50, 0.5, 0.02}));
  const convex::SupportGraph& graph = blade.derived<convex::SupportGraph>();
  Rng rng(25);
  for (std::uint64_t i = 0; i < test::cases(200); ++i) {
    convex::PairPose pose;
    pose.rotation =
        rotation_about(test::random_direction(rng), std::pow(10.0, rng.uniform(-14, -3)));
    pose.translation = {rng.uniform(-1, 1), rng.uniform(-3, 3), rng.uniform(-0.5, 0.5)};
    ClosestActiveSet query(blade, blade);
    const test::Judge judge(blade, blade, pose, kToleranceMm);
    judge_query(judge, query, pose);
    const PosedPair pair(graph, graph, pose);
    const WideNearest wide = wide_nearest(pair, {pair.point(0, 0)}, 1, 1e-10);
    judge.expect_verdict(wide.verdict);
    if (wide.verdict != convex::Verdict::Apart) continue;
    judge.expect_closest(closest_of(pair, wide.points, wide.nearest));
  }
}

TEST(ClosestActiveSet, DoesNotAllocateInAQuery) {
  const convex::ConvexBody body = test::body_of(test::lattice_ball_points(5));
  ClosestActiveSet query(body, body);
  Rng rng(26);
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 200; ++i) {
    const convex::PairPose pose = test::random_pose(rng, 12);
    (void)query.meets(pose);
    (void)query.closest(pose);
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

TEST(ClosestActiveSet, SaysUnknownForAPoseThatIsNotANumber) {
  const convex::ConvexBody body = test::body_of(test::box_points({1, 1, 1}));
  ClosestActiveSet query(body, body);
  convex::PairPose pose;
  pose.translation.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(query.meets(pose), convex::Verdict::Unknown);
  EXPECT_FALSE(query.closest(pose).has_value());
  EXPECT_EQ(query.meets({}), convex::Verdict::Meet);
}

}  // namespace
}  // namespace carpus::survey
