// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/lp/growth_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "convex/bodies_test_support.hpp"
#include "convex/exact_meeting.hpp"
#include "core/allocation_test_support.hpp"
#include "core/rng.hpp"

namespace carpus::survey {
namespace {

std::vector<const convex::ConvexBody*> pointers_to(const std::vector<convex::ConvexBody>& bodies) {
  std::vector<const convex::ConvexBody*> result;
  for (const convex::ConvexBody& body : bodies) result.push_back(&body);
  return result;
}

convex::Verdict exact_verdict(const GrowthScene& scene,
                              const std::vector<convex::ConvexBody>& bodies,
                              const std::vector<BodyPose>& poses,
                              std::size_t pair) {
  const auto [i, j] = scene.pair(pair);
  return convex::exactly_meet({&bodies[i], poses[i].rotation, poses[i].translation},
                              {&bodies[j], poses[j].rotation, poses[j].translation}, {})
      .verdict;
}

/// Seven bodies in a heap.
std::vector<convex::ConvexBody> some_bodies(Rng& rng) {
  std::vector<convex::ConvexBody> bodies;
  for (int i = 0; i < 5; ++i) bodies.push_back(test::pebble(rng, 80));
  bodies.push_back(test::box({4, 4, 4}));
  bodies.push_back(test::prism(12, 1, 20));
  return bodies;
}

TEST(GrowthScene, StaysExactWithAndWithoutItsBudget) {
  Rng rng(1);
  const std::vector<convex::ConvexBody> bodies = some_bodies(rng);
  GrowthScene scene(pointers_to(bodies));
  GrowthScene asking(pointers_to(bodies), false);
  EXPECT_EQ(scene.pair_count(), 21U);
  std::vector<BodyPose> poses(bodies.size());
  for (BodyPose& pose : poses) pose.translation = test::random_direction(rng) * 16;
  std::size_t meeting = 0;
  for (int tick = 0; tick < 600; ++tick) {
    const bool is_jump = tick % 100 == 99;
    for (BodyPose& pose : poses) {
      const double step = is_jump ? 4 : 0.05;
      pose.rotation =
          rotation_about(test::random_direction(rng), is_jump ? 0.5 : 0.002) * pose.rotation;
      pose.translation += test::random_direction(rng) * step;
      if (length(pose.translation) > 20) pose.translation *= 0.9;
    }
    const SceneTick done = scene.update(poses);
    (void)asking.update(poses);
    EXPECT_EQ(done.unknown, 0U);
    meeting += done.meeting;
    for (std::size_t p = 0; p < scene.pair_count(); ++p) {
      ASSERT_EQ(scene.verdicts()[p], asking.verdicts()[p]) << tick << " " << p;
      if ((tick + static_cast<int>(p)) % 23 != 0) continue;
      ASSERT_EQ(scene.verdicts()[p], exact_verdict(scene, bodies, poses, p)) << tick << " " << p;
    }
  }
  EXPECT_GT(meeting, 600U);
  EXPECT_LT(meeting, 600U * 20);
  EXPECT_GT(scene.counts().by_budget, 600U * 10);
  EXPECT_EQ(asking.counts().by_budget, 0U);
}

TEST(GrowthScene, IsExactWhereBodiesTouchInTheWorld) {
  std::vector<convex::ConvexBody> cubes;
  for (int i = 0; i < 3; ++i) cubes.push_back(test::box({1, 1, 1}));
  GrowthScene scene(pointers_to(cubes));
  std::vector<BodyPose> poses(3);
  for (int i = 0; i < 40; ++i) {
    const double shift = 1000.0 + i;
    poses[0].translation = {shift, 0, 0};
    poses[1].translation = {shift + 2, i * 0.03, 0};
    poses[2].translation = {i % 2 == 0 ? shift + 4 : std::nextafter(shift + 4, 1e6), 0, 0};
    (void)scene.update(poses);
    EXPECT_EQ(scene.verdicts()[0], convex::Verdict::Meet);
    EXPECT_EQ(scene.verdicts()[1], convex::Verdict::Apart);
    EXPECT_EQ(scene.verdicts()[2], i % 2 == 0 ? convex::Verdict::Meet : convex::Verdict::Apart)
        << i;
  }
}

TEST(GrowthScene, KnowsNothingOfPosesThatAreNoneAndRecovers) {
  std::vector<convex::ConvexBody> cubes;
  for (int i = 0; i < 3; ++i) cubes.push_back(test::box({1, 1, 1}));
  GrowthScene scene(pointers_to(cubes));
  std::vector<BodyPose> poses(3);
  poses[1].translation.x = 5;
  poses[2].translation.x = 6;
  (void)scene.update(poses);
  EXPECT_EQ(scene.verdicts()[2], convex::Verdict::Meet);
  poses[1].translation.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scene.update(poses).unknown, 2U);
  EXPECT_EQ(scene.verdicts()[1], convex::Verdict::Apart);
  poses[1].translation.x = 0.5;
  EXPECT_EQ(scene.update(poses).unknown, 0U);
  EXPECT_EQ(scene.verdicts()[0], convex::Verdict::Meet);
  EXPECT_EQ(scene.verdicts()[2], convex::Verdict::Apart);
  poses[1].rotation.rows[0].x = 3;  // no rotation: longer along x
  (void)scene.update(poses);
  EXPECT_EQ(scene.verdicts()[0], convex::Verdict::Meet);
  EXPECT_EQ(scene.verdicts()[2], convex::Verdict::Apart);
  poses[1].rotation.rows[0].x = 4.5;
  (void)scene.update(poses);
  EXPECT_EQ(scene.verdicts()[2], convex::Verdict::Meet);
}

TEST(GrowthScene, DoesNotAllocateInAnUpdate) {
  Rng rng(2);
  const std::vector<convex::ConvexBody> bodies = some_bodies(rng);
  GrowthScene scene(pointers_to(bodies));
  std::vector<BodyPose> poses(bodies.size());
  carpus::test::start_counting_allocations();
  for (int tick = 0; tick < 100; ++tick) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i].translation = {3.0 * static_cast<double>(i), 0.1 * tick, 0};
    }
    (void)scene.update(poses);
    if (tick % 20 == 0) scene.forget();
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

}  // namespace
}  // namespace carpus::survey
