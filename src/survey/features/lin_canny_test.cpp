// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/lin_canny.hpp"

#include <gtest/gtest.h>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"
#include "survey/features/detail/lin_canny_steps.hpp"
#include "survey/features/detail/walk.hpp"

namespace carpus::survey {
namespace {

TEST(LinCanny, TakesOneStepWhereTheLastFeaturesAreStillTheNearest) {
  Rng rng(1);
  const convex::VoronoiFeatures a(test::round_body(rng, 100));
  const convex::VoronoiFeatures b(test::round_body(rng, 100));
  const convex::FixedBody first{&a};
  convex::PairPose pose{test::random_rotation(rng), {30, 2, 1}};
  convex::FeaturePair pair;
  const convex::MovedBody second(a, b, pose);
  ASSERT_EQ(detail::walk(first, second, pair, 1000, detail::LinCannySteps::step).kind,
            detail::WalkEnd::Kind::Apart);
  pose.translation.x += 1e-9;
  const convex::MovedBody moved(a, b, pose);
  EXPECT_EQ(detail::walk(first, moved, pair, 1000, detail::LinCannySteps::step).steps, 1U);
}

/// What the limits in the list of methods say: overlap may stay without an answer, but is never
/// taken for a distance; bodies apart always get one.
TEST(LinCanny, FailsOnlyOnOverlapAndSaysSo) {
  int unanswered = 0;
  int overlapping = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    const convex::ConvexBody first = test::round_body(rng, 40);
    const convex::ConvexBody second = test::round_body(rng, 40);
    const auto query = make_lin_canny(first, second);
    for (int step = 0; step < 40; ++step) {
      const convex::PairPose pose{test::random_rotation(rng), test::random_vector(rng) * 9.0};
      const convex::Verdict verdict = query->meets(pose);
      // The ellipsoids around the bodies keep away beyond 26 mm, those inside meet within 10 mm.
      const double between = length(pose.translation);
      if (between > 26) {
        EXPECT_EQ(verdict, convex::Verdict::Apart);
      }
      if (between < 10) {
        EXPECT_NE(verdict, convex::Verdict::Apart);
      }
      overlapping += between < 10 ? 1 : 0;
      unanswered += verdict == convex::Verdict::Unknown ? 1 : 0;
    }
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_LE(unanswered, overlapping / 20);
}

}  // namespace
}  // namespace carpus::survey
