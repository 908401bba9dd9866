// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// tests/oracles judges verdicts of all kinds of pairs; here, the smallest steps from touching.
#include "collision/closest/certain_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collision/closest/detail/solids.hpp"

namespace carpus::collision {
namespace {

Verdict verdict_at(const ConvexBody& body, const PairPose& pose) {
  const SupportGraph& graph = body.derived<SupportGraph>();
  GjkWalk walk(ClimbStart::LastCorner);
  const PosedPair pair(graph, graph, pose);
  const Verdict cold = certain_verdict(walk, pair, body, body, pose);
  EXPECT_EQ(certain_verdict(walk, pair, body, body, pose), cold);
  return cold;
}

TEST(CertainVerdict, TellsTheLastBitOfAGap) {
  const ConvexBody box = test::body_of(test::box_points({1, 2, 3}));
  const double infinity = std::numeric_limits<double>::infinity();
  const Mat3 same = Mat3::identity();
  EXPECT_EQ(verdict_at(box, {same, {2, 0, 0}}), Verdict::Meet);    // faces
  EXPECT_EQ(verdict_at(box, {same, {2, 4, 0.5}}), Verdict::Meet);  // edges
  EXPECT_EQ(verdict_at(box, {same, {-2, 4, -6}}), Verdict::Meet);  // corners
  EXPECT_EQ(verdict_at(box, {same, {std::nextafter(2.0, infinity), 1, 1}}), Verdict::Apart);
  EXPECT_EQ(verdict_at(box, {same, {std::nextafter(2.0, 0.0), 1, 1}}), Verdict::Meet);
  EXPECT_EQ(verdict_at(box, {same, {2, std::nextafter(4.0, infinity), 6}}), Verdict::Apart);
  EXPECT_EQ(verdict_at(box, {same, {1e-300, 0, 0}}), Verdict::Meet);
}

TEST(CertainVerdict, TellsItFarFromTheOriginToo) {
  const Vec3 far{0x1p20, -0x1p21, 0x1p19};
  const ConvexBody box = test::shifted(test::body_of(test::box_points({1, 2, 3})), far);
  const double last = 0x1p-32;  // more than a unit in the last place out there
  EXPECT_EQ(verdict_at(box, {Mat3::identity(), {2, 1, 1}}), Verdict::Meet);
  EXPECT_EQ(verdict_at(box, {Mat3::identity(), {2 + last, 1, 1}}), Verdict::Apart);
  EXPECT_EQ(verdict_at(box, {Mat3::identity(), {2 - last, 1, 1}}), Verdict::Meet);
}

TEST(CertainVerdict, IsUnknownForWhatIsNotANumber) {
  const ConvexBody box = test::body_of(test::box_points({1, 2, 3}));
  PairPose pose;
  pose.rotation.rows[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict_at(box, pose), Verdict::Unknown);
}

}  // namespace
}  // namespace carpus::collision
