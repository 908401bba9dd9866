// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Examples, outcomes and limits; tests/oracles/motion_oracle_test.cpp compares times with
// bisection.
#include "survey/motion/contact_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/rng.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::survey {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

convex::ConvexBody body_of(const std::vector<Vec3>& points) {
  return convex::ConvexBody(hull::build_fast_hull(points).polytope);
}

convex::ConvexBody box(const Vec3& half) {
  std::vector<Vec3> corners(8);
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? half.x : -half.x, (i & 2U) != 0 ? half.y : -half.y,
                  (i & 4U) != 0 ? half.z : -half.z};
  }
  return body_of(corners);
}

convex::ConvexBody octahedron(double radius) {
  return body_of({{radius, 0, 0},
                  {-radius, 0, 0},
                  {0, radius, 0},
                  {0, -radius, 0},
                  {0, 0, radius},
                  {0, 0, -radius}});
}

convex::PairPose moved(const Vec3& translation) { return {Mat3::identity(), translation}; }

TEST(ContactInterval, TellsWhenAndWhereBoxesWillMeet) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  const ContactInterval way = query.query(moved({10, 0.5, 0}), {-4, 0, 0});
  EXPECT_EQ(way.outcome, MotionOutcome::WillMeet);
  EXPECT_NEAR(way.t_min_s, 2, 1e-12);
  EXPECT_NEAR(way.t_max_s, 3, 1e-12);
  EXPECT_NEAR(way.distance_mm(), 8, 1e-12);
  EXPECT_NEAR(way.first.point.x, 1, 1e-12);
  EXPECT_NEAR(distance(way.first.normal, {1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(distance(way.last.normal, {-1, 0, 0}), 0, 1e-12);
}

TEST(ContactInterval, TellsHowLongAndHowDeepBodiesTouch) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  const ContactInterval touch = query.query(moved({1.5, 0, 0}), {-2, 0, 0});
  EXPECT_EQ(touch.outcome, MotionOutcome::Touching);
  EXPECT_NEAR(touch.touching_since_s(), 0.25, 1e-12);
  EXPECT_NEAR(touch.depth_along_motion_mm(), 0.5, 1e-12);
  EXPECT_NEAR(touch.t_max_s, 1.75, 1e-12);
}

TEST(ContactInterval, TellsThatBodiesHavePassedOrNeverMeet) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  const ContactInterval passed = query.query(moved({10, 0, 0}), {4, 0, 0});
  EXPECT_EQ(passed.outcome, MotionOutcome::HasPassed);
  EXPECT_NEAR(passed.t_min_s, -3, 1e-12);
  EXPECT_NEAR(passed.t_max_s, -2, 1e-12);
  EXPECT_EQ(query.query(moved({10, 2.5, 0}), {-4, 0, 0}).outcome, MotionOutcome::NeverMeet);
  EXPECT_EQ(query.query(moved({10, 0, 0}), {0, 4, 0}).outcome, MotionOutcome::NeverMeet);
}

TEST(ContactInterval, CountsTheFirstAndTheLastMomentAsTouch) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  for (const double way : {1.0, -1.0}) {
    EXPECT_EQ(query.query(moved({2, 0.25, 0}), {way, 0, 0}).outcome, MotionOutcome::Touching);
    EXPECT_EQ(query.query(moved({2, 0, 0}), {0, way, 0}).outcome, MotionOutcome::Touching);
    EXPECT_EQ(query.query(moved({2, 2, 2}), {way, way, way}).outcome, MotionOutcome::Touching);
  }
}

TEST(ContactInterval, CountsGlancingAsTouch) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  const ContactInterval glancing = query.query(moved({10, 2, 0}), {-4, 0, 0});  // along a face
  EXPECT_EQ(glancing.outcome, MotionOutcome::WillMeet);
  EXPECT_NEAR(glancing.t_min_s, 2, 1e-9);
  const ContactInterval edges = query.query(moved({10, 2, 2}), {-4, 0, 0});  // along an edge
  EXPECT_EQ(edges.outcome, MotionOutcome::WillMeet);
}

TEST(ContactInterval, MeetsSolidsOfSymmetryCornerToCornerAndEdgeToEdge) {
  const convex::ConvexBody star = octahedron(3);
  ContactIntervalQuery query(star, star);
  const ContactInterval corners = query.query(moved({20, 0, 0}), {-1, 0, 0});
  EXPECT_NEAR(corners.t_min_s, 14, 1e-12);
  EXPECT_NEAR(corners.t_max_s, 26, 1e-12);
  const ContactInterval edges = query.query(moved({20, 3, 0}), {-1, 0, 0});
  EXPECT_NEAR(edges.t_min_s, 17, 1e-12);  // |x| + 3 = 6
  const ContactInterval nested =
      ContactIntervalQuery(box({5, 5, 5}), octahedron(1)).query(moved({}), {0, 0, 2});
  EXPECT_EQ(nested.outcome, MotionOutcome::Touching);
  EXPECT_NEAR(nested.t_min_s, -3, 1e-12);
  EXPECT_NEAR(nested.t_max_s, 3, 1e-12);
}

TEST(ContactInterval, WithoutMotionSaysWhetherBodiesTouchForEver) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  const ContactInterval touch = query.query(moved({2, 1, 0}), {});
  EXPECT_EQ(touch.outcome, MotionOutcome::Touching);
  EXPECT_EQ(touch.t_min_s, -kInfinity);
  EXPECT_EQ(touch.t_max_s, kInfinity);
  EXPECT_EQ(query.query(moved({2.001, 1, 0}), {}).outcome, MotionOutcome::NeverMeet);
  EXPECT_EQ(query.query(moved({0, 0, 0}), {}).outcome, MotionOutcome::Touching);
}

TEST(ContactInterval, TakesEverySpeedThatANumberCanHold) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  for (const double speed : {1e-90, 1e-9, 1.0, 1e9, 1e90}) {
    const ContactInterval way = query.query(moved({10, 0, 0}), {-speed, 0, 0});
    EXPECT_EQ(way.outcome, MotionOutcome::WillMeet) << speed;
    EXPECT_NEAR(way.t_min_s * speed, 8, 1e-12) << speed;
    EXPECT_NEAR(way.distance_mm(), 8, 1e-12) << speed;
  }
}

TEST(ContactInterval, NamesNumbersBeyondItsRange) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  EXPECT_EQ(query.query(moved({}), {1e101, 0, 0}).outcome, MotionOutcome::ScaleRange);
  EXPECT_EQ(query.query(moved({}), {0, 1e-101, 0}).outcome, MotionOutcome::ScaleRange);
  EXPECT_EQ(query.query(moved({1e101, 0, 0}), {1, 0, 0}).outcome, MotionOutcome::ScaleRange);
}

TEST(ContactInterval, TakesBodiesOfEverySize) {
  for (const double size : {1e-60, 1e-3, 1e6, 1e60}) {
    const convex::ConvexBody cube = box(Vec3{1, 1, 1} * size);
    const ContactInterval way =
        ContactIntervalQuery(cube, cube).query(moved({10 * size, 0, 0}), {-1, 0, 0});
    EXPECT_EQ(way.outcome, MotionOutcome::WillMeet) << size;
    EXPECT_NEAR(way.t_min_s / size, 8, 1e-12) << size;
  }
}

TEST(ContactInterval, NamesWhatIsNotFinite) {
  const convex::ConvexBody cube = box({1, 1, 1});
  ContactIntervalQuery query(cube, cube);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(query.query(moved({nan, 0, 0}), {1, 0, 0}).outcome, MotionOutcome::NotFinite);
  EXPECT_EQ(query.query(moved({}), {1, nan, 0}).outcome, MotionOutcome::NotFinite);
  EXPECT_EQ(query.query(moved({}), {1, 0, kInfinity}).outcome, MotionOutcome::NotFinite);
  convex::PairPose pose;
  pose.rotation.rows[2].x = nan;
  EXPECT_EQ(query.query(pose, {1, 0, 0}).outcome, MotionOutcome::NotFinite);
  EXPECT_EQ(query.query(moved({}), {1, 0, 0}).outcome, MotionOutcome::Touching);  // and recovers
}

TEST(ContactInterval, AnswersWarmAsColdWithFewerPivotsAndWithoutAllocation) {
  Rng rng(11);
  std::vector<Vec3> cloud(300);
  for (Vec3& point : cloud) {
    const Vec3 p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
    point = {9 * p.x, 6 * p.y, 5 * p.z};
  }
  const convex::ConvexBody bone = body_of(cloud);
  ContactIntervalQuery warm(bone, bone);
  ContactIntervalQuery cold(bone, bone);
  convex::PairPose pose = moved({20, 3, 2});
  Vec3 velocity{-30, 2, 1};
  double worst_mm = 0;
  int differences = 0;
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 500; ++i) {
    pose.rotation = rotation_about({0.6, 0, 0.8}, 0.002) * pose.rotation;
    pose.translation += velocity * 0.001 + Vec3{rng.normal(), rng.normal(), rng.normal()} * 0.02;
    velocity += Vec3{rng.normal(), rng.normal(), rng.normal()} * 0.1;
    cold.forget();
    const ContactInterval a = warm.query(pose, velocity);
    const ContactInterval b = cold.query(pose, velocity);
    differences += a.outcome == b.outcome ? 0 : 1;
    if (a.outcome == MotionOutcome::NeverMeet) continue;
    worst_mm = std::max(worst_mm, a.speed_mm_per_s * std::abs(a.t_min_s - b.t_min_s));
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(differences, 0);
  EXPECT_LT(worst_mm, 1e-8);
  EXPECT_GT(warm.statistics().warm_programs, 800U);
  EXPECT_LT(warm.statistics().pivots, cold.statistics().pivots / 4);
  EXPECT_EQ(warm.statistics().pivot_limits + cold.statistics().pivot_limits, 0U);
}

}  // namespace
}  // namespace carpus::survey
