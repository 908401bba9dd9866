// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every kind of volume against all pairs of triangles.
#include "survey/volumes/surface_query.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::survey {
namespace {

bool brute_force(const TriangleMesh& a, const TriangleMesh& b, const convex::PairPose& pose) {
  for (const Triangle& s : a.facets) {
    const TrianglePoints p{a.vertices[s[0]], a.vertices[s[1]], a.vertices[s[2]]};
    for (const Triangle& t : b.facets) {
      const TrianglePoints q{moved_corner(pose, b.vertices[t[0]]),
                             moved_corner(pose, b.vertices[t[1]]),
                             moved_corner(pose, b.vertices[t[2]])};
      if (triangles_meet(p, q)) return true;
    }
  }
  return false;
}

/// A ring with a rippled tube: as far from convex as a surface of so few triangles can be.
TriangleMesh ring(std::uint32_t around, std::uint32_t tube, double radius, double thickness) {
  TriangleMesh mesh;
  constexpr double kTurn = 6.283185307179586;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < tube; ++j) {
      const double u = kTurn * i / around;
      const double v = kTurn * j / tube;
      const double r = thickness * (1 + 0.2 * std::cos(3 * u));
      const double w = radius + r * std::cos(v);
      mesh.vertices.push_back({w * std::cos(u) + 4, w * std::sin(u), r * std::sin(v) - 2});
      const std::uint32_t i1 = (i + 1) % around;
      const std::uint32_t j1 = (j + 1) % tube;
      mesh.facets.push_back({i * tube + j, i1 * tube + j, i1 * tube + j1});
      mesh.facets.push_back({i * tube + j, i1 * tube + j1, i * tube + j1});
    }
  }
  return mesh;
}

/// Triangles anywhere, on whole numbers, some of them segments or points.
TriangleMesh litter(Rng& rng, std::size_t count) {
  TriangleMesh mesh;
  const auto c = [&] { return static_cast<double>(rng.below(7)); };
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 at{c(), c(), c()};
    mesh.vertices.push_back(at);
    mesh.vertices.push_back(at + Vec3{c() / 2, c() / 2, 0});
    mesh.vertices.push_back(at + Vec3{c() / 2, 0, c() / 2});
    const std::uint32_t v = 3 * i;
    mesh.facets.push_back({v, v + (rng.below(5) == 0 ? 0 : 1), v + (rng.below(5) == 0 ? 0 : 2)});
  }
  return mesh;
}

convex::PairPose jump(Rng& rng, double range) {
  return {rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal()),
          {rng.uniform(-range, range), rng.uniform(-range, range), rng.uniform(-range, range)}};
}

void step(convex::PairPose& pose, Rng& rng) {
  pose.translation += Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * 0.3;
  pose.rotation = rotation_about({0, 0, 1}, rng.uniform(-0.03, 0.03)) * pose.rotation;
}

/// The first body in the second one's frame.
convex::PairPose swapped(const convex::PairPose& pose) {
  const Mat3 back = pose.rotation.transposed();
  return {back, -(back * pose.translation)};
}

template <typename Volume>
class SurfaceQueryOf : public testing::Test {};
using Volumes = testing::Types<AxisBox, OrientedBox, KDop<6>, KDop<14>, KDop<18>, KDop<26>>;
TYPED_TEST_SUITE(SurfaceQueryOf, Volumes);

/// Of the contact that an answer names.
bool names_a_contact(const TriangleMesh& a,
                     const TriangleMesh& b,
                     const convex::PairPose& pose,
                     const TriangleContact& contact) {
  const TriangleMesh only_a{a.vertices, {a.facets[contact.first_facet]}};
  const TriangleMesh only_b{b.vertices, {b.facets[contact.second_facet]}};
  return brute_force(only_a, only_b, pose);
}

TYPED_TEST(SurfaceQueryOf, AgreesWithAllPairsOfTrianglesAlongTrajectoriesAndJumps) {
  const TriangleMesh a = ring(9, 4, 8, 2);
  const TriangleMesh b = ring(7, 3, 6, 1);
  const VolumeTree<TypeParam> tree_a(a);
  const VolumeTree<TypeParam> tree_b(b);
  SurfaceQuery<TypeParam> query(tree_a, tree_b);
  Rng rng(1);
  convex::PairPose pose;
  int touching = 0;
  for (int i = 0; i < 240; ++i) {
    if (i % 12 == 0) pose = jump(rng, 11);
    step(pose, rng);
    const bool expected = brute_force(a, b, pose);
    const SurfaceAnswer answer = query.query(pose);
    ASSERT_EQ(answer.touch, expected ? SurfaceTouch::Touch : SurfaceTouch::Apart) << i;
    if (!expected) continue;
    ++touching;
    ASSERT_TRUE(names_a_contact(a, b, pose, answer.contact));
  }
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 180);
  EXPECT_GT(query.counts().decided_by_memory, 20U);
  EXPECT_LT(query.counts().triangle_tests, 240U * 72U * 42U / 50U);  // two in a hundred
}

TYPED_TEST(SurfaceQueryOf, AgreesOnSegmentsPointsAndTrianglesThatJustTouch) {
  Rng rng(2);
  int touching = 0;
  for (int i = 0; i < 150; ++i) {
    const TriangleMesh a = litter(rng, 1 + rng.below(12));
    const TriangleMesh b = litter(rng, 1 + rng.below(12));
    const VolumeTree<TypeParam> tree_a(a);
    const VolumeTree<TypeParam> tree_b(b);
    convex::PairPose pose;  // a quarter turn and whole steps: nothing is rounded
    if (rng.below(2) == 0) pose.rotation = Mat3{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
    pose.translation = {static_cast<double>(rng.below(9)), static_cast<double>(rng.below(9)), 0};
    const bool expected = brute_force(a, b, pose);
    ASSERT_EQ(SurfaceQuery<TypeParam>(tree_a, tree_b).query(pose).touch,
              expected ? SurfaceTouch::Touch : SurfaceTouch::Apart);
    ASSERT_EQ(SurfaceQuery<TypeParam>(tree_b, tree_a).query(swapped(pose)).touch,
              expected ? SurfaceTouch::Touch : SurfaceTouch::Apart);
    touching += expected ? 1 : 0;
  }
  EXPECT_GT(touching, 15);
  EXPECT_LT(touching, 120);
}

TYPED_TEST(SurfaceQueryOf, SeesSurfacesNotBodiesAndEmptyOnesNever) {
  const TriangleMesh big = ring(8, 6, 20, 5);
  TriangleMesh small;
  small.vertices = {{24, 0, -2}, {24.1, 0, -2}, {24, 0.1, -2}};
  small.facets = {{0, 1, 2}};
  const VolumeTree<TypeParam> tree(big);
  const VolumeTree<TypeParam> within(small);
  const SurfaceAnswer answer = SurfaceQuery<TypeParam>(tree, within).query({});
  EXPECT_EQ(answer.touch, SurfaceTouch::Apart);
  EXPECT_FALSE(answer.decided_by_roots);
  const VolumeTree<TypeParam> empty(TriangleMesh{});
  EXPECT_EQ(SurfaceQuery<TypeParam>(tree, empty).query({}).touch, SurfaceTouch::Apart);
  EXPECT_EQ(SurfaceQuery<TypeParam>(empty, tree).query({}).touch, SurfaceTouch::Apart);
}

TYPED_TEST(SurfaceQueryOf, KnowsNothingWhereThePoseIsNotUsable) {
  const TriangleMesh mesh = ring(6, 4, 8, 2);
  const VolumeTree<TypeParam> tree(mesh);
  SurfaceQuery<TypeParam> query(tree, tree);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e101}) {
    convex::PairPose pose;
    pose.translation.z = bad;
    EXPECT_EQ(query.query(pose).touch, SurfaceTouch::Unknown);
    pose.translation.z = 0;
    pose.rotation.rows[2].y = bad;
    EXPECT_EQ(query.query(pose).touch, SurfaceTouch::Unknown);
  }
  EXPECT_EQ(query.query({}).touch, SurfaceTouch::Touch);
}

TYPED_TEST(SurfaceQueryOf, AllocatesNothing) {
  const TriangleMesh a = ring(9, 4, 8, 2);
  const VolumeTree<TypeParam> tree(a);
  SurfaceQuery<TypeParam> query(tree, tree);
  Rng rng(3);
  convex::PairPose pose;
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 100; ++i) {
    if (i % 10 == 0) pose = jump(rng, 10);
    if (i % 20 == 0) query.forget();
    (void)query.query(pose);
    step(pose, rng);
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

TYPED_TEST(SurfaceQueryOf, RefusesSurfacesThatAreNone) {
  TriangleMesh mesh = ring(6, 4, 8, 2);
  mesh.facets[3][1] = 1000;
  EXPECT_THROW(VolumeTree<TypeParam>{mesh}, InvalidInput);
  mesh = ring(6, 4, 8, 2);
  mesh.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(VolumeTree<TypeParam>{mesh}, InvalidInput);
}

}  // namespace
}  // namespace carpus::survey
