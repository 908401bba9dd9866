// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/i_collide.hpp"
#include "survey/methods.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"
#include "core/allocation_test_support.hpp"

namespace carpus::survey {
namespace {

std::vector<convex::ConvexBody> some_bodies(Rng& rng) {
  std::vector<convex::ConvexBody> bodies;
  for (int i = 0; i < 9; ++i) bodies.push_back(test::round_body(rng, 40));
  return bodies;
}

BodyPose random_place(Rng& rng) {
  return {test::random_rotation(rng), test::random_vector(rng) * 18.0};
}

void step(std::vector<BodyPose>& poses, Rng& rng) {
  for (BodyPose& pose : poses) {
    const Vec3 axis = normalized_or(test::random_vector(rng), {1, 0, 0});
    pose.rotation = rotation_about(axis, 0.03 * rng.normal()) * pose.rotation;
    pose.translation += test::random_vector(rng) * 0.3;
    if (rng.below(40) == 0) pose = random_place(rng);
  }
}

TEST(ICollide, GivesEachPairTheVerdictOfAMethodThatSeesIt) {
  Rng rng(1);
  const std::vector<convex::ConvexBody> bodies = some_bodies(rng);
  ICollide collide(bodies);
  Scene scene(bodies, *find_method("v_clip"), BroadPhase::None);
  ASSERT_EQ(collide.pair_count(), scene.pair_count());
  std::vector<BodyPose> poses;
  for (std::size_t i = 0; i < bodies.size(); ++i) poses.push_back(random_place(rng));
  std::size_t meeting = 0;
  std::size_t queries = 0;
  std::size_t unknown = 0;
  constexpr int kTicks = 300;
  for (int tick = 0; tick < kTicks; ++tick) {
    step(poses, rng);
    const SceneTick now = collide.update(poses);
    scene.update(poses);
    for (std::size_t i = 0; i < collide.pair_count(); ++i) {
      if (collide.verdicts()[i] == convex::Verdict::Unknown) {
        EXPECT_EQ(scene.verdicts()[i], convex::Verdict::Meet);
      } else {
        EXPECT_EQ(collide.verdicts()[i], scene.verdicts()[i]);
      }
    }
    meeting += now.meeting;
    queries += now.queries;
    unknown += now.unknown;
  }
  EXPECT_GT(meeting, 100U);
  EXPECT_LT(queries, kTicks * collide.pair_count() / 2);
  EXPECT_LE(unknown, meeting / 20);
}

TEST(ICollide, KnowsNothingOfABodyWithoutAPose) {
  Rng rng(2);
  const std::vector<convex::ConvexBody> bodies = some_bodies(rng);
  ICollide collide(bodies);
  std::vector<BodyPose> poses(bodies.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].translation = {100.0 * static_cast<double>(i), 0, 0};
  }
  EXPECT_EQ(collide.update(poses).unknown, 0U);
  poses[3].translation.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(collide.update(poses).unknown, bodies.size() - 1);
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      const convex::Verdict expected =
          i == 3 || j == 3 ? convex::Verdict::Unknown : convex::Verdict::Apart;
      EXPECT_EQ(collide.verdicts()[pair_number(i, j, bodies.size())], expected);
    }
  }
}

TEST(ICollide, AllocatesNothingInATick) {
  Rng rng(3);
  const std::vector<convex::ConvexBody> bodies = some_bodies(rng);
  ICollide collide(bodies);
  std::vector<BodyPose> poses;
  for (std::size_t i = 0; i < bodies.size(); ++i) poses.push_back(random_place(rng));
  carpus::test::start_counting_allocations();
  for (int tick = 0; tick < 100; ++tick) {
    step(poses, rng);
    collide.update(poses);
    if (tick == 50) collide.forget();
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

}  // namespace
}  // namespace carpus::survey
