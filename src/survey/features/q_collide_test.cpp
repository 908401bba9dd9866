// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/q_collide.hpp"

#include <gtest/gtest.h>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"

namespace carpus::survey {
namespace {

TEST(QCollide, TellsParallelFacesApartDownToTheTolerance) {
  const convex::ConvexBody cube = test::box({4, 4, 4});
  const auto query = make_q_collide(cube, cube);
  Rng rng(1);
  for (int sample = 0; sample < 300; ++sample) {
    query->forget();
    const double gap = sample % 2 == 0 ? 1e-8 : -1e-8;
    const convex::PairPose pose{Mat3::identity(),
                                {rng.uniform(-7, 7), 8 + gap, rng.uniform(-7, 7)}};
    EXPECT_EQ(query->meets(pose), gap > 0 ? convex::Verdict::Apart : convex::Verdict::Meet);
  }
}

TEST(QCollide, GivesNoDistance) {
  const convex::ConvexBody cube = test::box({4, 4, 4});
  EXPECT_FALSE(make_q_collide(cube, cube)->closest({Mat3::identity(), {20, 0, 0}}));
}

/// A vector kept from before the bodies passed each other points the wrong way.
TEST(QCollide, FindsANewVectorAfterTheBodiesChangeSides) {
  Rng rng(2);
  const convex::ConvexBody first = test::round_body(rng, 80);
  const convex::ConvexBody second = test::round_body(rng, 80);
  const auto query = make_q_collide(first, second);
  for (int sample = 0; sample < 100; ++sample) {
    const Vec3 side = normalized_or(test::random_vector(rng), {1, 0, 0}) * 28.0;
    EXPECT_EQ(query->meets({test::random_rotation(rng), side}), convex::Verdict::Apart);
    EXPECT_EQ(query->meets({test::random_rotation(rng), -side}), convex::Verdict::Apart);
    EXPECT_EQ(query->meets({test::random_rotation(rng), side * 0.1}), convex::Verdict::Meet);
  }
}

}  // namespace
}  // namespace carpus::survey
