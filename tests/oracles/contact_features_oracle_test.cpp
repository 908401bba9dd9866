// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/contact_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "convex/bodies_test_support.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/polar_graph.hpp"
#include "core/rng.hpp"
#include "survey/closest/active_set.hpp"
#include "survey/closest/depth.hpp"

namespace carpus::convex {
namespace {

struct Pair {
  ConvexBody first;
  ConvexBody second;
  ProofBody first_proofs{first};
  ProofBody second_proofs{second};

  Pair(Rng& rng, int points)
      : first(test::pebble(rng, points)), second(test::pebble(rng, points)) {}

  [[nodiscard]] RelativePose relative(const PairPose& pose) const {
    RelativePose result;
    EXPECT_TRUE(relative_pose(*first_proofs.facets, *second_proofs.facets, pose, result));
    return result;
  }
  [[nodiscard]] ContactEnd walk(const PairPose& pose, FeaturePair& features) const {
    return walk_to_contact(*first_proofs.features, *second_proofs.features, relative(pose),
                           features);
  }
  [[nodiscard]] bool is_common(const PairPose& pose, const Vec3& x) const {
    const RelativePose placed = relative(pose);
    return first_proofs.facets->top(x).gauge <= 1 &&
           second_proofs.facets->top(placed.into_second(x - placed.offset)).gauge <= 1;
  }
  /// Along the line between the interior points, so that the surfaces are `gap` apart or, below
  /// zero, that deep.
  [[nodiscard]] PairPose at_gap(Rng& rng, double gap) {
    const Vec3 way = test::random_direction(rng);
    PairPose pose{test::random_rotation(rng), {}};
    pose.translation = first.interior_point() - pose.rotation * second.interior_point() + way * 40;
    survey::ClosestActiveSet method(first, second);
    for (int i = 0; i < 60; ++i) {
      const auto closest = method.closest(pose);
      if (!closest || closest->distance_mm < 1e-7) break;
      pose.translation -= closest->normal * closest->distance_mm;
      pose.translation += closest->normal * 1e-8;
    }
    const auto closest = method.closest(pose);
    EXPECT_TRUE(closest.has_value());
    if (closest) pose.translation += closest->normal * gap;
    return pose;
  }
};

TEST(ContactFeatures, AreTheNearestOnesFromAnywhereOnBodiesThatAreApart) {
  Rng rng(3);
  for (int i = 0; i < 300; ++i) {
    const Pair bodies(rng, i % 2 == 0 ? 12 : 200);
    const PairPose pose{test::random_rotation(rng), test::random_direction(rng) * 45};
    survey::ClosestActiveSet method(bodies.first, bodies.second);
    const auto expected = method.closest(pose);
    if (!expected || expected->distance_mm < 0.1) continue;
    FeaturePair features{
        Feature::vertex(static_cast<std::uint32_t>(rng.below(bodies.first.vertices().size()))),
        Feature::vertex(static_cast<std::uint32_t>(rng.below(bodies.second.vertices().size())))};
    ContactEnd end;
    for (int walks = 0; walks < 20 && end.kind == ContactEnd::Kind::Open; ++walks) {
      end = bodies.walk(pose, features);
    }
    ASSERT_EQ(end.kind, ContactEnd::Kind::Apart) << i;
    const FixedBody first{bodies.first_proofs.features};
    const MovedBody second(*bodies.first_proofs.features, *bodies.second_proofs.features, pose);
    const auto closest = closest_of(first, second, features);
    ASSERT_TRUE(closest.has_value());
    EXPECT_NEAR(closest->distance_mm, expected->distance_mm, 1e-9) << i;
  }
}

TEST(ContactFeatures, FollowASmallMotionInAFewSteps) {
  Rng rng(4);
  int apart = 0;
  for (int i = 0; i < 60; ++i) {
    Pair bodies(rng, 300);
    PairPose pose = bodies.at_gap(rng, 0.02);
    FeaturePair features{Feature::vertex(0), Feature::vertex(0)};
    for (int walks = 0; walks < 20; ++walks) (void)bodies.walk(pose, features);
    for (int tick = 0; tick < 20; ++tick) {
      pose.rotation = rotation_about(test::random_direction(rng), 0.001) * pose.rotation;
      if (bodies.walk(pose, features).kind == ContactEnd::Kind::Apart) ++apart;
    }
  }
  EXPECT_GT(apart, 60 * 20 * 3 / 4);  // others overlap
}

TEST(ContactFeatures, GiveAPointInBothBodiesWhereTheseOverlapALittle) {
  Rng rng(5);
  int overlaps = 0;
  int common = 0;
  for (int i = 0; i < 200; ++i) {
    Pair bodies(rng, 200);
    const PairPose pose = bodies.at_gap(rng, 0.001);
    FeaturePair features{Feature::vertex(0), Feature::vertex(0)};
    for (int walks = 0; walks < 20; ++walks) (void)bodies.walk(pose, features);
    const FixedBody first{bodies.first_proofs.features};
    const MovedBody second(*bodies.first_proofs.features, *bodies.second_proofs.features, pose);
    const auto closest = closest_of(first, second, features);
    ASSERT_TRUE(closest.has_value());
    PairPose deeper = pose;
    deeper.translation -= closest->normal * 0.006;
    FeaturePair kept = features;
    const ContactEnd end = bodies.walk(deeper, kept);
    ASSERT_NE(end.kind, ContactEnd::Kind::Apart) << i;
    if (end.kind != ContactEnd::Kind::Overlap) continue;
    ++overlaps;
    common += bodies.is_common(deeper, end.middle) ? 1 : 0;
  }
  EXPECT_GT(overlaps, 190);
  EXPECT_GT(common, overlaps * 9 / 10);
}

TEST(ContactFeatures, EndOnBodiesThatTouchWithoutGoingRound) {
  Rng rng(6);
  int ended = 0;
  for (int i = 0; i < 200; ++i) {
    Pair bodies(rng, 60);
    const PairPose pose = bodies.at_gap(rng, 0);
    FeaturePair features{Feature::vertex(0), Feature::vertex(0)};
    ContactEnd end;
    for (int walks = 0; walks < 20 && end.kind == ContactEnd::Kind::Open; ++walks) {
      end = bodies.walk(pose, features);
    }
    ended += end.kind == ContactEnd::Kind::Open ? 0 : 1;
  }
  EXPECT_EQ(ended, 200);
}

TEST(ContactFeatures, EndOnAnyMatrixWhatever) {
  Rng rng(7);
  const Pair bodies(rng, 100);
  for (int i = 0; i < 2000; ++i) {
    RelativePose pose;
    for (Vec3& row : pose.rotation.rows) row = {rng.normal(), rng.normal(), rng.normal()};
    pose.offset = test::random_direction(rng) * rng.uniform(0, 20);
    if (i % 10 == 0) pose.offset.x = std::nan("");
    if (i % 10 == 1) pose.rotation = Mat3{};
    FeaturePair features{Feature::face(0), Feature::vertex(1)};
    (void)walk_to_contact(*bodies.first_proofs.features, *bodies.second_proofs.features, pose,
                          features);
    const bool has_face =
        features.first.kind == FeatureKind::Face || features.second.kind == FeatureKind::Face;
    const bool has_vertex =
        features.first.kind == FeatureKind::Vertex || features.second.kind == FeatureKind::Vertex;
    EXPECT_TRUE(!has_face || has_vertex);  // a face is never paired with an edge or a face
  }
}

}  // namespace
}  // namespace carpus::convex
