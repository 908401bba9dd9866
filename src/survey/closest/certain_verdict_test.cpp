// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// tests/oracles judges verdicts of all kinds of pairs; here, the smallest steps from touching.
#include "survey/closest/certain_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "convex/bodies_test_support.hpp"

namespace carpus::survey {
namespace {

convex::Verdict verdict_at(const convex::ConvexBody& body, const convex::PairPose& pose) {
  const convex::SupportGraph& graph = body.derived<convex::SupportGraph>();
  GjkWalk walk(ClimbStart::LastCorner);
  const PosedPair pair(graph, graph, pose);
  const convex::Verdict cold = certain_verdict(walk, pair, body, body, pose);
  EXPECT_EQ(certain_verdict(walk, pair, body, body, pose), cold);
  return cold;
}

TEST(CertainVerdict, TellsTheLastBitOfAGap) {
  const convex::ConvexBody box = test::body_of(test::box_points({1, 2, 3}));
  const double infinity = std::numeric_limits<double>::infinity();
  const Mat3 same = Mat3::identity();
  EXPECT_EQ(verdict_at(box, {same, {2, 0, 0}}), convex::Verdict::Meet);    // faces
  EXPECT_EQ(verdict_at(box, {same, {2, 4, 0.5}}), convex::Verdict::Meet);  // edges
  EXPECT_EQ(verdict_at(box, {same, {-2, 4, -6}}), convex::Verdict::Meet);  // corners
  EXPECT_EQ(verdict_at(box, {same, {std::nextafter(2.0, infinity), 1, 1}}), convex::Verdict::Apart);
  EXPECT_EQ(verdict_at(box, {same, {std::nextafter(2.0, 0.0), 1, 1}}), convex::Verdict::Meet);
  EXPECT_EQ(verdict_at(box, {same, {2, std::nextafter(4.0, infinity), 6}}), convex::Verdict::Apart);
  EXPECT_EQ(verdict_at(box, {same, {1e-300, 0, 0}}), convex::Verdict::Meet);
}

TEST(CertainVerdict, TellsItFarFromTheOriginToo) {
  const Vec3 far{0x1p20, -0x1p21, 0x1p19};
  const convex::ConvexBody box = test::shifted(test::body_of(test::box_points({1, 2, 3})), far);
  const double last = 0x1p-32;  // more than a unit in the last place out there
  EXPECT_EQ(verdict_at(box, {Mat3::identity(), {2, 1, 1}}), convex::Verdict::Meet);
  EXPECT_EQ(verdict_at(box, {Mat3::identity(), {2 + last, 1, 1}}), convex::Verdict::Apart);
  EXPECT_EQ(verdict_at(box, {Mat3::identity(), {2 - last, 1, 1}}), convex::Verdict::Meet);
}

TEST(CertainVerdict, TrustsNoTetrahedronWhoseVolumeIsRounding) {
  // A needle 5e11 mm long ends beside a plate; the walk begins with corners of an earlier pose,
  // which make a tetrahedron so thin that on one of its faces even the side of the fourth corner
  // is lost.
  const convex::ConvexBody plate = test::body_of({{0.25, 0.5, 0},
                                                  {0, 0.25, 0.000125},
                                                  {0, 0.375, 0.000375},
                                                  {0.25, 0.125, 0.000375},
                                                  {0.375, 0.5, 0.000125},
                                                  {0.125, 0.5, 0.000375},
                                                  {0.25, 0.25, 0.0005},
                                                  {0.5, 0.25, 0.000125}});
  const convex::ConvexBody needle = test::body_of({{-1.578125, -0.078125, -0.28125},
                                                   {1.90625, 1.90625, -1.84375},
                                                   {0.796875, -1.609375, -1.453125},
                                                   {0.53125, 1.296875, 1.53125},
                                                   {1.0625, 1.453125, 0.859375},
                                                   {-1.703125, -0.828125, -549755813888},
                                                   {0.09375, -1.796875, 1.609375},
                                                   {-0.578125, 1.609375, 1.78125},
                                                   {-1.984375, -1.953125, 0.09375}});
  const convex::PairPose pose{
      {{Vec3{-0.52715460359354349, -0.69576692721551103, -0.48786925185260366},
        Vec3{0.19226474469596999, -0.65688762562176395, 0.72906303928535166},
        Vec3{-0.82773322505329394, 0.29052888031671914, 0.48005278651913519}}},
      {-67052239405.683022, 100201661134.27032, 191605745998.16266}};
  GjkWalk walk(ClimbStart::LastCorner);
  walk.set_points({{{{}, 2, 1}, {{}, 7, 5}, {{}, 7, 1}, {{}, 4, 2}}}, 4);
  const PosedPair pair(plate.derived<convex::SupportGraph>(),
                       needle.derived<convex::SupportGraph>(), pose);
  EXPECT_EQ(certain_verdict(walk, pair, plate, needle, pose), convex::Verdict::Apart);
}

TEST(CertainVerdict, IsUnknownForWhatIsNotANumber) {
  const convex::ConvexBody box = test::body_of(test::box_points({1, 2, 3}));
  convex::PairPose pose;
  pose.rotation.rows[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict_at(box, pose), convex::Verdict::Unknown);
}

}  // namespace
}  // namespace carpus::survey
