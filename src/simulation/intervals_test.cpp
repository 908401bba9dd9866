// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two pairs of bones in one place: of bodies 0 and 1, which have parted far enough for a probe, and
// of 2 and 3, which have not. Deeper than z = 0 each pair lies 0.6 mm apart as scanned.
#include "simulation/detail/intervals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace carpus::simulation::detail {
namespace {

constexpr std::uint8_t kDistalJoint = 1;
constexpr double kProbeMm = 0.5;
constexpr double kScopeMm = 1.35;
constexpr double kHalfWideMm = 0.3;
constexpr double kPartedMm = 1.5;
const Vec3 kMouth{0, 0, -0.3};
const Vec3 kDeep{0, 0, 4};

/// All that is deeper than z = 0 on one side of the interval.
Grid<float> bone(double side) {
  GridGeometry geometry;
  geometry.size = {41, 41, 41};
  geometry.spacing = {0.25, 0.25, 0.25};
  geometry.origin = {-5, -5, -4};
  std::vector<float> values;
  for (int z = 0; z < 41; ++z) {
    for (int y = 0; y < 41; ++y) {
      const double before = 4 - z * 0.25;
      const double aside = kHalfWideMm - side * (y * 0.25 - 5);
      const double outside = std::hypot(std::max(before, 0.0), std::max(aside, 0.0));
      const double distance = outside + std::min(0.0, std::max(before, aside));
      values.insert(values.end(), 41, static_cast<float>(distance));
    }
  }
  return {geometry, values};
}

YieldingSheet before_interval(std::uint8_t first, std::uint8_t second) {
  static const Grid<float> kFirst = bone(-1);
  static const Grid<float> kSecond = bone(1);
  YieldingSheet sheet;
  sheet.first = first;
  sheet.second = second;
  sheet.joint = 0;
  sheet.interval = {&kFirst, &kSecond, 1.6, kDistalJoint};
  return sheet;
}

using Sheets = std::vector<YieldingSheet>;
const YieldingSheet kDisc{};
const YieldingSheet kOpen = before_interval(0, 1);
const YieldingSheet kClosed = before_interval(2, 3);

arthroscopy::InInterval in(const Sheets& sheets,
                           const Vec3& at,
                           double radius_mm = kProbeMm,
                           std::uint8_t joint = kDistalJoint) {
  std::array<Pose<frame::Bone, frame::Patient>, 4> inverses;
  inverses[0].translation = {0, kPartedMm / 2, 0};
  inverses[1].translation = {0, -kPartedMm / 2, 0};
  return in_intervals(sheets, inverses, joint, at, radius_mm);
}

TEST(Intervals, ASheetIsMetFromBehindFromTheJointAlongTheOtherSideOfItsInterval) {
  EXPECT_TRUE(lies_behind(kOpen, kDistalJoint));
  EXPECT_FALSE(lies_behind(kOpen, kOpen.joint)) << "from there it is met from before";
  EXPECT_FALSE(lies_behind(kDisc, kDistalJoint)) << "it has no interval";
}

TEST(Intervals, EachIsAskedWithItsOwnBones) {
  EXPECT_TRUE(in({kDisc, kOpen}, kDeep).is_between);
  EXPECT_EQ(in({kDisc, kOpen}, kDeep).depth_mm, 0);
  EXPECT_FALSE(in({kDisc, kClosed}, kDeep).is_between);
  EXPECT_GT(in({kDisc, kClosed}, kDeep).depth_mm, 0);
  EXPECT_GT(in({kDisc, kOpen}, kDeep, kScopeMm).depth_mm, 0) << "a scope is too thick";
}

TEST(Intervals, FromAJointThatTheyDoNotOpenIntoThereAreNone) {
  const auto none = in({kDisc, kOpen, kClosed}, kDeep, kProbeMm, 0);
  EXPECT_FALSE(none.is_between);
  EXPECT_EQ(none.depth_mm, 0);
  EXPECT_EQ(none.off_mm, 0);
}

TEST(Intervals, OfSeveralTheOneThatStopsItMostDoesInAnyOrder) {
  const double deep = in({kClosed}, kMouth).depth_mm;
  for (const Sheets& sheets : {Sheets{kOpen, kClosed}, Sheets{kClosed, kOpen}}) {
    const auto both = in(sheets, kMouth);
    EXPECT_EQ(both.depth_mm, deep);
    EXPECT_LT(both.out.z, -0.5) << "out by its mouth";
  }
}

TEST(Intervals, BesideOneThatLetsItInTheNearerWayLeadsBack) {
  const Vec3 beside{0, 0, -1.6};
  const auto open = in({kClosed, kOpen}, beside);
  ASSERT_GT(open.off_mm, 0);
  EXPECT_GT(open.back.z, 0.5);
  EXPECT_EQ(in({kClosed}, beside).off_mm, 0) << "it does not let it in";
  EXPECT_TRUE(leads_back(open, open.off_mm + 0.1, true));
  EXPECT_FALSE(leads_back(open, open.off_mm - 0.1, true)) << "the joint is nearer";
  EXPECT_TRUE(leads_back(open, open.off_mm - 0.1, false)) << "of no joint is known";
  EXPECT_FALSE(leads_back(in({kOpen}, kDeep), 1.0, false)) << "it is in it";
}

}  // namespace
}  // namespace carpus::simulation::detail
