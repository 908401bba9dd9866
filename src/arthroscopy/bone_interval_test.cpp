// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/bone_interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carpus::arthroscopy {
namespace {

constexpr double kProbeMm = 0.5;
constexpr double kThickScopeMm = 1.35;
constexpr double kHalfWide = 0.3;  // of the interval as scanned

/// A block 8 mm high, from `kHalfWide` to 6 mm on one side of y = 0; below z = 0 the joint is.
Grid<float> block(double side) {
  GridGeometry geometry;
  geometry.size = {61, 71, 71};
  geometry.spacing = {0.25, 0.25, 0.25};
  geometry.origin = {-7.5, -8.75, -4};
  std::vector<float> values;
  for (int z = 0; z < 71; ++z) {
    for (int y = 0; y < 71; ++y) {
      for (int x = 0; x < 61; ++x) {
        const double dx = std::abs(x * 0.25 - 7.5) - 4;
        const double dy =
            std::abs((y * 0.25 - 8.75) * side - (6 + kHalfWide) / 2) - (6 - kHalfWide) / 2;
        const double dz = std::abs(z * 0.25 - 4 - 4) - 4;
        const double outside =
            std::sqrt(std::pow(std::max(dx, 0.0), 2) + std::pow(std::max(dy, 0.0), 2) +
                      std::pow(std::max(dz, 0.0), 2));
        values.push_back(static_cast<float>(outside + std::min(0.0, std::max({dx, dy, dz}))));
      }
    }
  }
  return {geometry, values};
}

/// Both blocks parted by so much, the second one higher by the step.
class Parted {
 public:
  explicit Parted(double gap_mm, double step_mm = 0) {
    first_.translation = {0, gap_mm / 2, 0};
    second_.translation = {0, -gap_mm / 2, -step_mm};
  }
  [[nodiscard]] InInterval at(const Vec3& place, double radius_mm) const {
    static const Grid<float> kFirst = block(-1);
    static const Grid<float> kSecond = block(1);
    return in_interval({&kFirst, &kSecond, 1.6, 0}, first_, second_, place, radius_mm);
  }
  /// Whether a ball comes so deep from the mouth, in the middle.
  [[nodiscard]] bool lets_in(double radius_mm, double deep_mm = 6) const {
    for (double z = -1; z <= deep_mm; z += 0.1) {
      if (at({0, 0, z}, radius_mm).depth_mm > 0) return false;
    }
    return at({0, 0, deep_mm}, radius_mm).is_between;
  }

 private:
  Pose<frame::Bone, frame::Patient> first_;
  Pose<frame::Bone, frame::Patient> second_;
};

TEST(BoneInterval, LetsInWhatIsThinnerThanTheBonesHaveParted) {
  EXPECT_FALSE(Parted(0.0).lets_in(kProbeMm));
  EXPECT_FALSE(Parted(0.6).lets_in(kProbeMm));
  EXPECT_TRUE(Parted(1.5).lets_in(kProbeMm));
  EXPECT_FALSE(Parted(1.5).lets_in(kThickScopeMm));
  EXPECT_TRUE(Parted(3.2).lets_in(kThickScopeMm));
  EXPECT_TRUE(Parted(1.5, 1.3).lets_in(kProbeMm)) << "out of line";
}

/// Bones that are wider apart than a probe as scanned are as tight: cartilage fills what is there.
TEST(BoneInterval, WholeItIsClosedWhateverTheWidthBetweenBones) {
  const InInterval in = Parted(0.0).at({0, 0, 0.4}, 0.1);
  EXPECT_GT(in.depth_mm, 0) << "a needle between bones that lie 0.6 mm apart";
  EXPECT_FALSE(in.is_between);
}

TEST(BoneInterval, WhatIsTooThickIsPushedBackToTheMouthWhateverSideItLiesOn) {
  for (const double gap : {0.0, 0.6}) {
    for (const double y : {-0.2, 0.0, 0.2}) {
      const InInterval in = Parted(gap).at({0, y, -0.3}, kProbeMm);
      EXPECT_GT(in.depth_mm, 0) << gap << " " << y;
      EXPECT_LT(in.depth_mm, 2);
      EXPECT_LT(in.out.z, -0.5) << gap << " " << y;
      EXPECT_FALSE(in.is_between);
    }
  }
}

TEST(BoneInterval, CartilageStopsATipThatGoesAsideInIt) {
  const Parted parted(2.0);
  EXPECT_EQ(parted.at({0, 0.4, 4}, kProbeMm).depth_mm, 0);
  const InInterval aside = parted.at({0, 0.7, 4}, kProbeMm);
  EXPECT_NEAR(aside.depth_mm, 0.2, 0.05);
  EXPECT_LT(aside.out.y, -0.9);
  const InInterval other = parted.at({0, -0.7, 4}, kProbeMm);
  EXPECT_NEAR(other.depth_mm, 0.2, 0.05);
  EXPECT_GT(other.out.y, 0.9);
}

TEST(BoneInterval, BesideItTheWayLeadsBack) {
  const Parted parted(2.6);
  const InInterval beside = parted.at({4.6, 0, 4}, kProbeMm);
  EXPECT_FALSE(beside.is_between);
  EXPECT_GT(beside.off_mm, 0);
  EXPECT_LT(beside.back.x, -0.7);
  EXPECT_EQ(Parted(0.6).at({4.6, 0, 4}, kProbeMm).off_mm, 0) << "to nothing that lets it in";
}

TEST(BoneInterval, FarFromItNothingOfItIsMet) {
  for (const Vec3& place : {Vec3{0, 0, -3.5}, Vec3{0, 5, -3}, Vec3{50, 0, 0}}) {
    const InInterval in = Parted(1.5).at(place, kProbeMm);
    EXPECT_FALSE(in.is_between);
    EXPECT_EQ(in.depth_mm, 0);
    EXPECT_EQ(in.off_mm, 0);
  }
}

}  // namespace
}  // namespace carpus::arthroscopy
