// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/v_clip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"
#include "survey/features/detail/v_clip_steps.hpp"
#include "survey/features/detail/walk.hpp"

namespace carpus::survey {
namespace {

using convex::FeaturePair;
using convex::FixedBody;
using convex::MovedBody;
using detail::VClipSteps;
using detail::WalkEnd;

TEST(VClip, GivesTheDistancesOfTwoCubesByEveryPairOfFeatures) {
  const convex::ConvexBody cube = test::box({1, 1, 1});
  const auto query = make_v_clip(cube, cube);
  const auto distance_at = [&](const Mat3& rotation, const Vec3& t) {
    const std::optional<convex::Closest> closest = query->closest({rotation, t});
    return closest ? closest->distance_mm : -1;
  };
  EXPECT_DOUBLE_EQ(distance_at(Mat3::identity(), {3, 0, 0}), 1);                // two faces
  EXPECT_DOUBLE_EQ(distance_at(Mat3::identity(), {3, 4, 5}), std::sqrt(14.0));  // two vertices
  const Mat3 turned = rotation_about({0, 0, 1}, std::numbers::pi / 4);
  EXPECT_NEAR(distance_at(turned, {4, 0, 0}), 3 - std::sqrt(2.0), 1e-14);  // an edge and a face
  const Mat3 crossed = rotation_about({1, 0, 0}, std::numbers::pi / 4) * turned;
  // Two edges: the second cube's edge along z, tilted about x, over the first one's edge along z.
  EXPECT_NEAR(distance_at(crossed, {4, 0, 0}), 3 - std::sqrt(2.0), 1e-14);
}

/// A vertex deep below the face it is paired with, in that face's prism, while the body it seems
/// to be in is a thin plate: the local minimum of [mirtich1998vclip]
TEST(VClip, LeavesTheLocalMinimumBelowAPlate) {
  const convex::ConvexBody plate = test::box({10, 10, 0.1});
  const convex::ConvexBody cube = test::box({1, 1, 1});
  const convex::VoronoiFeatures of_plate(plate);
  const convex::VoronoiFeatures of_cube(cube);
  std::uint32_t top = 0;
  while (of_plate.plane(top).normal.z < 0.5) ++top;
  for (const double below : {-1.5, -3.0, -40.0}) {
    const convex::FixedBody first{&of_plate};
    const convex::MovedBody second(of_plate, of_cube, {Mat3::identity(), {3, 2, below}});
    convex::FeaturePair pair{convex::Feature::face(top), convex::Feature::vertex(0)};
    const WalkEnd end = detail::walk(first, second, pair, 50, VClipSteps::step);
    ASSERT_EQ(end.kind, WalkEnd::Kind::Apart);
    const auto closest = closest_of(first, second, pair);
    ASSERT_TRUE(closest);
    EXPECT_NEAR(closest->distance_mm, -below - 1.1, 1e-14);
  }
}

TEST(VClip, EndsFromEveryPairOfFeaturesToStartFrom) {
  Rng rng(4);
  for (int sample = 0; sample < 12; ++sample) {
    const convex::VoronoiFeatures a(test::random_body(rng));
    const convex::VoronoiFeatures b(test::random_body(rng));
    const convex::PairPose pose{test::random_rotation(rng), test::random_vector(rng) * 8.0};
    const convex::FixedBody first{&a};
    const convex::MovedBody second(a, b, pose);
    double known = -1;
    for (std::uint32_t v = 0; v < a.vertex_count(); ++v) {
      for (std::uint32_t f = 0; f < b.face_count(); ++f) {
        convex::FeaturePair pair{a.spoke_edge(v, 0), convex::Feature::face(f)};
        const WalkEnd end = detail::walk(first, second, pair, 1000, VClipSteps::step);
        const auto answer = answer_of(first, second, pair, end, VClipSteps::step);
        double found = 0;
        if (answer.kind != WalkEnd::Kind::Overlap) {
          ASSERT_TRUE(answer.closest);
          found = answer.closest->distance_mm;
        }
        if (known < 0) known = found;
        EXPECT_NEAR(found, known, 1e-10);
      }
    }
  }
}

}  // namespace
}  // namespace carpus::survey
