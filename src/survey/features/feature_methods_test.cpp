// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What every method of this folder owes its contract. That the answers are right is also compared
// with slow oracles in tests/oracles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"
#include "convex/pair_query.hpp"
#include "core/allocation_test_support.hpp"
#include "survey/methods.hpp"

namespace carpus::survey {
namespace {

class FeatureMethods : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] static const Method& method() { return *find_method(GetParam()); }
};

TEST_P(FeatureMethods, GiveNearestPointsOnBothBodiesAlongTrajectories) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Rng rng(seed);
    const convex::ConvexBody first = test::random_body(rng);
    const convex::ConvexBody second = test::random_body(rng);
    const auto query = method().make(first, second);
    test::Trajectory trajectory(seed + 1000);
    for (int step = 0; step < 40; ++step) {
      const convex::PairPose pose = trajectory.next(8);
      const convex::Verdict verdict = query->meets(pose);
      const std::optional<convex::Closest> closest = query->closest(pose);
      ASSERT_EQ(closest.has_value(), method().gives_distance && verdict == convex::Verdict::Apart);
      if (closest && closest->distance_mm > 1e-6) {
        test::expect_nearest(first, second, pose, *closest);
      }
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST_P(FeatureMethods, AnswerTheSameWarmAndCold) {
  Rng rng(7);
  const convex::ConvexBody first = test::round_body(rng, 120);
  const convex::ConvexBody second = test::round_body(rng, 90);
  const auto warm = method().make(first, second);
  const auto cold = method().make(first, second);
  test::Trajectory trajectory(8);
  int apart = 0;
  for (int step = 0; step < 600; ++step) {
    const convex::PairPose pose = trajectory.next(14);
    cold->forget();
    const convex::Verdict verdict = warm->meets(pose);
    ASSERT_EQ(verdict, cold->meets(pose));
    const std::optional<convex::Closest> a = warm->closest(pose);
    cold->forget();
    const std::optional<convex::Closest> b = cold->closest(pose);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_NEAR(a->distance_mm, b->distance_mm, 1e-9);
    }
    apart += verdict == convex::Verdict::Apart ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
  EXPECT_LT(apart, 500);
}

TEST_P(FeatureMethods, AreSymmetricAndBlindToTheFrame) {
  Rng rng(3);
  for (int sample = 0; sample < 200; ++sample) {
    const convex::ConvexBody first = test::random_body(rng);
    const convex::ConvexBody second = test::random_body(rng);
    const convex::PairPose pose{test::random_rotation(rng), test::random_vector(rng) * 8.0};
    const auto forward = method().make(first, second);
    const auto backward = method().make(second, first);
    const Pose<convex::pair_frame::Second, convex::pair_frame::First> swapped = pose.inverse();
    const convex::PairPose back{swapped.rotation, swapped.translation};
    ASSERT_EQ(forward->meets(pose), backward->meets(back));
    const std::optional<convex::Closest> a = forward->closest(pose);
    const std::optional<convex::Closest> b = backward->closest(back);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_NEAR(a->distance_mm, b->distance_mm, 1e-9);
      EXPECT_NEAR(length(a->normal + pose.rotation * b->normal), 0, 1e-5);
    }
  }
}

TEST_P(FeatureMethods, ChangeTheDistanceNoMoreThanTheBodyMoves) {
  if (!method().gives_distance) GTEST_SKIP() << "verdicts only";
  Rng rng(5);
  const convex::ConvexBody first = test::round_body(rng, 60);
  const convex::ConvexBody second = test::box({2, 5, 3});
  const auto query = method().make(first, second);
  convex::PairPose pose{test::random_rotation(rng), {25, 0, 0}};
  double before = -1;
  for (int step = 0; step < 2000; ++step) {
    const Vec3 move = test::random_vector(rng) * 0.3;
    pose.translation += move;
    const std::optional<convex::Closest> closest = query->closest(pose);
    const double now = closest ? closest->distance_mm : 0;
    if (before >= 0) {
      EXPECT_LE(std::abs(now - before), length(move) + 1e-9);
    }
    before = now;
  }
}

TEST_P(FeatureMethods, CallTouchingMeeting) {
  const convex::ConvexBody cube = test::box({4, 4, 4});
  const auto query = method().make(cube, cube);
  for (const Vec3& t : {Vec3{8, 0, 0}, Vec3{8, 8, 8}, Vec3{0, -8, 8}, Vec3{3, 2, 8}}) {
    EXPECT_EQ(query->meets({Mat3::identity(), t}), convex::Verdict::Meet);
    EXPECT_EQ(query->meets({Mat3::identity(), t * (1 + 1e-7)}), convex::Verdict::Apart);
    EXPECT_EQ(query->meets({Mat3::identity(), t * (1 - 1e-7)}), convex::Verdict::Meet);
  }
}

TEST_P(FeatureMethods, FindANestedBody) {
  const convex::ConvexBody big = test::box({10, 10, 10});
  const convex::ConvexBody small = test::box({1, 2, 1});
  for (const bool swap : {false, true}) {
    const auto query = swap ? method().make(small, big) : method().make(big, small);
    for (const Vec3& t : {Vec3{}, Vec3{5, 6, -7}, Vec3{-8, 1, 0}}) {
      EXPECT_EQ(query->meets({Mat3::identity(), t}), convex::Verdict::Meet);
    }
  }
}

TEST_P(FeatureMethods, TakeThePoseAsGivenWhereItIsNoRotation) {
  const convex::ConvexBody cube = test::box({1, 1, 1});
  const auto query = method().make(cube, cube);
  Mat3 shear;
  shear.rows[0] = {1, 0.25, 0};  // x grows with y: the far corner comes 0.25 mm nearer
  EXPECT_EQ(query->meets({shear, {-2.2, 0, 0}}), convex::Verdict::Meet);
  EXPECT_EQ(query->meets({shear, {-2.3, 0, 0}}), convex::Verdict::Apart);
  const std::optional<convex::Closest> closest = query->closest({shear, {-2.75, 0, 0}});
  if (method().gives_distance) {
    ASSERT_TRUE(closest);
    EXPECT_NEAR(closest->distance_mm, 0.5, 1e-12);
  }
}

TEST_P(FeatureMethods, DoNotAnswerForAPoseThatIsNotFinite) {
  const convex::ConvexBody cube = test::box({1, 1, 1});
  const auto query = method().make(cube, cube);
  convex::PairPose pose;
  pose.translation.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(query->meets(pose), convex::Verdict::Unknown);
  pose = {};
  pose.rotation.rows[1].z = std::numeric_limits<double>::infinity();
  EXPECT_EQ(query->meets(pose), convex::Verdict::Unknown);
  EXPECT_FALSE(query->closest(pose));
  pose = {};
  pose.translation.x = 1e200;  // finite, but its square is not
  EXPECT_EQ(query->meets(pose), convex::Verdict::Unknown);
  EXPECT_FALSE(query->closest(pose));
  pose = {};
  pose.translation = {3, 0, 0};
  EXPECT_EQ(query->meets(pose), convex::Verdict::Apart);
}

TEST_P(FeatureMethods, AllocateNothingInQueries) {
  Rng rng(11);
  const convex::ConvexBody first = test::round_body(rng, 200);
  const convex::ConvexBody second = test::round_body(rng, 150);
  const auto query = method().make(first, second);
  test::Trajectory trajectory(12);
  carpus::test::start_counting_allocations();
  for (int step = 0; step < 300; ++step) {
    const convex::PairPose pose = trajectory.next(14);
    (void)query->meets(pose);
    (void)query->closest(pose);
    if (step % 50 == 0) query->forget();
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

INSTANTIATE_TEST_SUITE_P(All,
                         FeatureMethods,
                         testing::Values("lin_canny", "i_collide", "v_clip", "swift", "q_collide"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace carpus::survey
