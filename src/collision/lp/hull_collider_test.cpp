// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Examples and limits; tests/oracles compares thousands of pairs with an exact oracle.
#include "collision/lp/hull_collider.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collision/allocation_test_support.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::collision {
namespace {

using BoneFromTool = Pose<frame::Bone, frame::Tool>;

/// A box by its planes and corners; what the collider reads of a polytope.
ConvexPolytope box(const Vec3& half) {
  ConvexPolytope result;
  for (int i = 0; i < 8; ++i) {
    result.vertices.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                               (i & 4) != 0 ? half.z : -half.z});
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Plane p;
      p.normal[axis] = sign;
      p.offset = half[axis];
      result.planes.push_back(p);
      result.planes.push_back(p);  // two triangles a face: every row is there twice
    }
  }
  return result;
}

HullContact query_once(const ConvexPolytope& bone,
                       const ConvexPolytope& tool,
                       const BoneFromTool& pose,
                       LpObjective objective) {
  HullCollider collider({&bone, 1}, tool, objective);
  return collider.query(0, pose);
}

TEST(HullCollider, AnswersForBoxesApartTouchingAndNested) {
  const ConvexPolytope big = box({4, 5, 6});
  const ConvexPolytope small = box({1, 1, 1});
  for (const LpObjective objective : {LpObjective::Sum, LpObjective::FollowBasis}) {
    const auto at = [&](const Vec3& t) {
      return query_once(big, small, {Mat3::identity(), t}, objective);
    };
    EXPECT_TRUE(at({0, 0, 0}).has_contact());
    EXPECT_TRUE(at({5, 0, 0}).has_contact());  // faces touch
    EXPECT_TRUE(at({5, 6, 7}).has_contact());  // corners touch
    const HullContact apart = at({5.001, 0, 0});
    EXPECT_EQ(apart.status, LpStatus::Infeasible);
    EXPECT_TRUE(apart.decided_by_boxes);
    EXPECT_EQ(apart.separating_normal.v, (Vec3{1, 0, 0}));
  }
}

TEST(HullCollider, SeparatesWhereBoxesOverlapAndRemembersWhy) {
  const ConvexPolytope bone = box({5, 5, 5});
  const ConvexPolytope tool = box({0.5, 0.5, 40});
  HullCollider collider({&bone, 1}, tool);
  // A bar passing an edge of the cube at 45 degrees.
  BoneFromTool pose{rotation_about({0, 1, 0}, -0.7853981633974483), {}};
  pose.translation = Vec3{1, 0, 1} * (5.0 + 0.55);
  const HullContact first = collider.query(0, pose);
  EXPECT_EQ(first.status, LpStatus::Infeasible);
  EXPECT_FALSE(first.decided_by_boxes);
  EXPECT_GT(dot(first.separating_normal.v, Vec3{1, 0, 1}), 1.2);
  pose.translation += Vec3{0.01, 0.02, 0};
  const HullContact second = collider.query(0, pose);
  EXPECT_TRUE(second.decided_by_memory);
  EXPECT_EQ(second.pivots, 0);
  pose.translation -= Vec3{0.3, 0, 0.3};
  EXPECT_TRUE(collider.query(0, pose).has_contact());
  EXPECT_EQ(collider.counts().queries, 3U);
  EXPECT_EQ(collider.counts().decided_by_memory, 1U);
  EXPECT_EQ(collider.counts().pivot_limits, 0U);
}

TEST(HullCollider, NeverAnswersContactForAPoseThatIsNotANumber) {
  const ConvexPolytope bone = box({5, 5, 5});
  HullCollider collider({&bone, 1}, box({1, 1, 1}));
  BoneFromTool pose;
  pose.translation.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(collider.query(0, pose).has_contact());
  pose = {};
  pose.rotation.rows[0].x = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(collider.query(0, pose).has_contact());
  EXPECT_TRUE(collider.query(0, {}).has_contact());  // and recovers
}

TEST(HullCollider, DoesNotAllocateInAQuery) {
  const ConvexPolytope bone = box({5, 5, 5});
  HullCollider collider({&bone, 1}, box({0.5, 0.5, 40}));
  test::start_counting_allocations();
  for (int i = 0; i < 200; ++i) {
    const BoneFromTool pose{rotation_about({0, 1, 0}, 0.03 * i), {0.05 * i, 0, 3}};
    (void)collider.query(0, pose);
  }
  EXPECT_EQ(test::stop_counting_allocations(), 0);
  EXPECT_GT(collider.counts().pivots, 0U);
}

TEST(HullCollider, RefusesHullsThatItCannotUse) {
  const ConvexPolytope good = box({1, 1, 1});
  const ConvexPolytope empty;
  EXPECT_THROW(HullCollider({&empty, 1}, good), InvalidInput);
  EXPECT_THROW(HullCollider({&good, 1}, empty), InvalidInput);
  ConvexPolytope round = good;
  round.planes.resize(kMaxToolFacets + 1);
  EXPECT_THROW(HullCollider({&good, 1}, round), InvalidInput);
}

TEST(WireCorners, EncloseTheRoundWireFromTipToEnd) {
  const WireShape shape{.radius_mm = 0.57, .length_mm = 100, .tip_mm = 2, .sides = 8};
  const std::vector<Vec3> corners = wire_corners(shape);
  EXPECT_EQ(corners.size(), 17U);
  EXPECT_EQ(corners.front(), Vec3{});
  for (std::size_t i = 1; i < corners.size(); ++i) {
    EXPECT_NEAR(std::hypot(corners[i].x, corners[i].y) * std::cos(kPi / 8), 0.57, 1e-12);
  }
  EXPECT_THROW((void)wire_corners({.radius_mm = -1}), InvalidInput);
}

}  // namespace
}  // namespace carpus::collision
