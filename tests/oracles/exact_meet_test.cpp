// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "oracles/exact_meet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "oracles/pair_generator.hpp"
#include "oracles/separating_axes.hpp"

namespace carpus::oracles {
namespace {

ConvexPolytope cube(double half) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        {(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half});
  }
  return hull::build_convex_hull(points).polytope;
}

TEST(ExactMeet, TellsCubesThatTouchFromCubesOneBitApart) {
  const ConvexPolytope a = cube(1);
  ExactMeet exact(a.vertices, a.vertices);
  const Mat3 straight = Mat3::identity();
  for (const Vec3& touching : {Vec3{2, 0, 0}, Vec3{2, 2, 0}, Vec3{-2, 2, 2}, Vec3{0.3, -2, 0.7}}) {
    EXPECT_TRUE(exact.query(straight, touching).meet);
    Vec3 apart = touching;
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(apart[i]) == 2) apart[i] = std::nextafter(apart[i], apart[i] * 9);
    }
    EXPECT_FALSE(exact.query(straight, apart).meet);
  }
  EXPECT_TRUE(exact.query(straight, {}).meet);
  EXPECT_FALSE(exact.query(straight, {1e7, 0, 0}).meet);
}

TEST(ExactMeet, TakesThePoseAsGivenEvenWhereItIsNoRotation) {
  const ConvexPolytope a = cube(1);
  ExactMeet exact(a.vertices, a.vertices);
  Mat3 pose;
  pose.rows[0].x = 1 + 0x1p-52;
  EXPECT_TRUE(exact.query(pose, {2, 0, 0}).meet);
  EXPECT_FALSE(exact.query(pose, {2 + 0x1p-51, 0, 0}).meet);
  pose.rows[0].x = 1 - 0x1p-53;
  EXPECT_FALSE(exact.query(pose, {2, 0, 0}).meet);
}

TEST(ExactMeet, AgreesWithAllSeparatingAxes) {
  int meeting = 0;
  int integers = 0;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    PairGenerator pairs(seed);
    ExactMeet exact(pairs.first.vertices, pairs.second.vertices);
    const auto first = body_of<long double>(pairs.first, Mat3::identity(), {});
    for (int i = 0; i < 8; ++i) {
      const Placement p = pairs.next();
      const ExactMeet::Answer answer = exact.query(p.rotation, p.translation);
      integers += answer.needed_integers;
      double reach = length(p.translation);
      for (const Vec3& v : pairs.second.vertices) reach = std::max(reach, length(v));
      const long double gap =
          separation(first, body_of<long double>(pairs.second, p.rotation, p.translation));
      if (std::abs(gap) < 1e-17L * reach + 1e-13L * pairs.size_mm) continue;
      ASSERT_EQ(answer.meet, gap <= 0) << "seed " << seed << " pose " << i;
      meeting += answer.meet;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(meeting, 50);
  EXPECT_GT(compared - meeting, 50);
  EXPECT_GT(integers, 25);
}

}  // namespace
}  // namespace carpus::oracles
