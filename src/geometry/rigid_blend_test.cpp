// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/rigid_blend.hpp"

#include <gtest/gtest.h>

namespace carpus {
namespace {

constexpr double kRight = 1.5707963267948966;

TEST(RigidBlend, OfOneMotionIsThatMotionAtAnyAngle) {
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0, -0.8}}) {
    for (int degrees = -180; degrees <= 180; degrees += 15) {
      const Mat3 turn = rotation_about(axis, degrees * kRight / 90);
      const Vec3 way{3, -7, 11};
      RigidBlend blend;
      blend.add(dual_quaternion(turn, way), 0.3);
      const Vec3 p{5, 2, -9};
      EXPECT_LT(distance(blend.moved(p), turn * p + way), 1e-12) << degrees;
    }
  }
}

TEST(RigidBlend, HalfWayBetweenTwoTurnsAboutAnAxisIsTheTurnBetweenAboutThatAxis) {
  const Vec3 pivot{10, 20, 30};
  const auto about_pivot = [&](double angle) {
    const Mat3 turn = rotation_about({0, 0, 1}, angle);
    return dual_quaternion(turn, pivot - turn * pivot);
  };
  RigidBlend blend;
  blend.add(about_pivot(0), 2.0);
  blend.add(about_pivot(kRight), 2.0);
  const Vec3 p{13, 20, 30};
  const Vec3 expected = pivot + rotation_about({0, 0, 1}, kRight / 2) * Vec3{3, 0, 0};
  EXPECT_LT(distance(blend.moved(p), expected), 1e-12);
  EXPECT_LT(distance(blend.moved(pivot), pivot), 1e-12);
}

TEST(RigidBlend, IsRigidWhateverItsWeights) {
  RigidBlend blend;
  blend.add(dual_quaternion(rotation_about({1, 0, 0}, 0.4), {1, 2, 3}), 0.2);
  blend.add(dual_quaternion(rotation_about({0, 0.8, 0.6}, -0.9), {-4, 0, 2}), 0.5);
  RigidBlend outer;
  outer.add(blend, 0.7);
  outer.add(dual_quaternion(rotation_about({0, 1, 0}, 2.9), {0, 9, 0}), 0.1);
  const Vec3 a{0, 0, 0};
  const Vec3 b{30, -10, 20};
  EXPECT_NEAR(distance(outer.moved(a), outer.moved(b)), distance(a, b), 1e-12);
}

TEST(RigidBlend, LeavesAPointWhereItIsWithoutMotions) {
  EXPECT_EQ(RigidBlend{}.moved({1, 2, 3}), (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace carpus
