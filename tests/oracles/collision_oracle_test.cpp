// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "collision/lp/hull_collider.hpp"
#include "core/rng.hpp"
#include "oracles/sample_bodies.hpp"
#include "oracles/separating_axes.hpp"

namespace carpus {
namespace {

using collision::HullCollider;
using collision::HullContact;
using collision::LpObjective;
using collision::LpStatus;
using oracles::axis_rotation;
using oracles::hull_of;
using oracles::integer_body;
using oracles::pebble;
using BoneFromTool = Pose<frame::Bone, frame::Tool>;

/// The normal really separates: the bone lies below the tool along it.
void expect_separates(const ConvexPolytope& bone,
                      const ConvexPolytope& tool,
                      const BoneFromTool& pose,
                      const Vec3& normal) {
  double high = -1e300;
  double low = 1e300;
  for (const Vec3& v : bone.vertices) high = std::max(high, dot(normal, v));
  for (const Vec3& v : tool.vertices) {
    low = std::min(low, dot(normal, pose.rotation * v + pose.translation));
  }
  EXPECT_GT(low - high, -1e-7);
}

void expect_common_point(const ConvexPolytope& bone,
                         const ConvexPolytope& tool,
                         const BoneFromTool& pose,
                         const Vec3& point) {
  const Vec3 in_tool = pose.rotation.transposed() * (point - pose.translation);
  for (const Plane& p : bone.planes) EXPECT_LE(p.signed_distance(point), 1e-8);
  for (const Plane& p : tool.planes) EXPECT_LE(p.signed_distance(in_tool), 1e-8);
}

TEST(CollisionOracle, AgreesWithIntegerArithmeticOnTouchingNestedAndSeparatedPairs) {
  std::array<int, 3> seen{};  // overlapping, touching, apart
  for (const LpObjective objective : {LpObjective::FollowBasis, LpObjective::Sum}) {
    std::uint64_t pivot_limits = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      Rng rng(seed);
      const ConvexPolytope bone = integer_body(rng);
      const ConvexPolytope tool = integer_body(rng);
      HullCollider collider({&bone, 1}, tool, objective);
      const auto exact_bone = oracles::body_of<long long>(bone, Mat3::identity(), {});
      for (int step = 0; step < 12; ++step) {  // the state of one answer starts the next
        BoneFromTool pose;
        if (step % 3 == 0) collider.forget();
        pose.rotation = axis_rotation(rng);
        const auto c = [&] { return static_cast<double>(rng.below(30)) - 12; };
        pose.translation = {c(), c(), c()};
        const auto exact_tool = oracles::body_of<long long>(tool, pose.rotation, pose.translation);
        const long long gap = oracles::separation(exact_bone, exact_tool);
        const HullContact contact = collider.query(0, pose);
        ASSERT_EQ(contact.has_contact(), gap <= 0) << "seed " << seed << " step " << step;
        ASSERT_NE(contact.status, LpStatus::PivotLimit);
        if (contact.has_contact()) {
          expect_common_point(bone, tool, pose, contact.common_point.v);
        } else {
          expect_separates(bone, tool, pose, contact.separating_normal.v);
        }
        ++seen[static_cast<std::size_t>(gap + 1)];
      }
      pivot_limits += collider.counts().pivot_limits;
    }
    EXPECT_EQ(pivot_limits, 0U);
  }
  EXPECT_GT(seen[0], 1000);
  EXPECT_GT(seen[1], 200);
  EXPECT_GT(seen[2], 1000);
}

TEST(CollisionOracle, AgreesAlongTrajectoriesOfAWireOverBones) {
  int contacts = 0;
  int scored = 0;
  int memory = 0;
  for (const LpObjective objective : {LpObjective::FollowBasis, LpObjective::Sum}) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Rng rng(seed);
      const ConvexPolytope bone = pebble(rng, 60);
      const ConvexPolytope wire =
          hull_of(collision::wire_corners({.radius_mm = 0.57, .length_mm = 60, .sides = 6}));
      HullCollider collider({&bone, 1}, wire, objective);
      const auto oracle_bone = oracles::body_of<long double>(bone, Mat3::identity(), {});
      BoneFromTool pose;
      const Vec3 axis = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
      pose.rotation = rotation_about(axis, rng.uniform(0, 6));
      pose.translation = {rng.uniform(-14, 14), rng.uniform(-14, 14), rng.uniform(-14, 14)};
      for (int tick = 0; tick < 40; ++tick) {
        pose.rotation = rotation_about(axis, rng.uniform(-0.01, 0.01)) * pose.rotation;
        pose.translation += Vec3{rng.normal(), rng.normal(), rng.normal()} * 0.15;
        if (rng.below(5) == 0) pose.translation *= 0.9;  // drawn towards the bone
        const auto oracle_wire =
            oracles::body_of<long double>(wire, pose.rotation, pose.translation);
        const long double gap = oracles::separation(oracle_bone, oracle_wire);
        const HullContact contact = collider.query(0, pose);
        ASSERT_NE(contact.status, LpStatus::PivotLimit);
        if (std::abs(gap) < 1e-7L) continue;  // within what the planes' rounding may decide
        ASSERT_EQ(contact.has_contact(), gap < 0) << "seed " << seed << " tick " << tick;
        if (!contact.has_contact()) {
          expect_separates(bone, wire, pose, contact.separating_normal.v);
        }
        ++scored;
        contacts += contact.has_contact();
        memory += contact.decided_by_memory;
      }
    }
  }
  EXPECT_GT(scored, 900);
  EXPECT_GT(contacts, 150);
  EXPECT_LT(contacts, scored - 150);
  EXPECT_GT(memory, 50);
}

TEST(CollisionOracle, FindsTheZeroOfAClosingGap) {
  // Two bodies approach along x until they touch; bisect the contact and compare with the oracle.
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    const ConvexPolytope bone = pebble(rng, 40);
    const ConvexPolytope tool = pebble(rng, 12);
    HullCollider collider({&bone, 1}, tool);
    BoneFromTool pose;
    pose.rotation = rotation_about(normalized_or({rng.normal(), rng.normal(), 1}, {}), 1.0);
    double touching = 0;
    double apart = 40;
    for (int i = 0; i < 60; ++i) {
      pose.translation = {(touching + apart) / 2, 0.3, -0.2};
      (collider.query(0, pose).has_contact() ? touching : apart) = pose.translation.x;
    }
    const auto gap_at = [&](double x) {
      return oracles::separation(
          oracles::body_of<long double>(bone, Mat3::identity(), {}),
          oracles::body_of<long double>(tool, pose.rotation, {x, 0.3, -0.2}));
    };
    EXPECT_LT(gap_at(touching - 1e-6), 0) << seed;
    EXPECT_GT(gap_at(apart + 1e-6), 0) << seed;
  }
}

}  // namespace
}  // namespace carpus
