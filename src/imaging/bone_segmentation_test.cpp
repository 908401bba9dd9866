// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/bone_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "imaging/gaussian.hpp"

namespace carpus::imaging {
namespace {

constexpr double kRadius = 6.0;
constexpr double kGap = 0.9;  // between the two, as in a joint

/// Two round bones with cortex and cancellous core in soft tissue, blurred, with noise: simulated.
struct TwoBones {
  Grid<std::int16_t> ct;
  Grid<std::uint8_t> truth;
};

TwoBones make_two_bones(double spacing_x, std::uint64_t seed) {
  GridGeometry g;
  g.size = {static_cast<int>(36 / spacing_x), 56, 48};
  g.spacing = {spacing_x, 0.3, 0.4};
  const Vec3 a{9, 8.4, 9.6};
  const Vec3 b = a + Vec3{2 * kRadius + kGap, 0, 0};
  Rng rng(seed);
  Grid<float> hu(g);
  TwoBones scan{Grid<std::int16_t>(g), Grid<std::uint8_t>(g)};
  for (std::size_t i = 0; i < hu.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p{v.x * g.spacing.x, v.y * g.spacing.y, v.z * g.spacing.z};
    const double depth = kRadius - std::min(distance(p, a), distance(p, b));
    hu[i] = depth < 0 ? 45.0F : (depth < 0.8 ? 1200.0F : 300.0F);
    scan.truth[i] = depth < 0 ? 0 : (distance(p, a) < distance(p, b) ? 1 : 2);
  }
  const Grid<float> blurred = gaussian_smooth(hu.view(), 0.25);
  for (std::size_t i = 0; i < hu.values().size(); ++i) {
    scan.ct[i] =
        static_cast<std::int16_t>(std::lround(static_cast<double>(blurred[i]) + 25 * rng.normal()));
  }
  return scan;
}

double dice(const BoneSegmentation& s, const TwoBones& scan, RegionLabel region, int truth) {
  std::size_t both = 0, in_region = 0, in_truth = 0;
  for (const std::uint8_t t : scan.truth.values()) in_truth += t == truth ? 1 : 0;
  for (std::size_t i = 0; i < s.regions.values().size(); ++i) {
    if (s.regions[i] != region) continue;
    VoxelIndex v = s.regions.geometry().index_of(i);
    v = {v.x + s.offset.x, v.y + s.offset.y, v.z + s.offset.z};
    ++in_region;
    both += scan.truth[v] == truth ? 1 : 0;
  }
  return 2.0 * static_cast<double>(both) / static_cast<double>(in_region + in_truth);
}

TEST(BoneSegmentation, PartsTwoBonesAcrossANarrowJoint) {
  for (const double spacing : {0.3, 0.45}) {
    const TwoBones scan = make_two_bones(spacing, 7);
    const BoneSegmentation s = segment_bones(scan.ct.view(), {}, no_progress);
    ASSERT_EQ(s.status, SegmentationStatus::Ok);
    ASSERT_EQ(s.region_count, 2);
    for (RegionLabel r = 1; r <= 2; ++r) {
      EXPECT_GT(std::max(dice(s, scan, r, 1), dice(s, scan, r, 2)), 0.96) << "spacing " << spacing;
    }
    EXPECT_NEAR(s.soft_tissue_hu, 45, 10);
  }
}

/// A bone of 24 mm with a crack at a third of its length, open all the way through.
Grid<std::int16_t> cracked_bone(double crack_mm, double filling_hu, std::size_t& bone_voxels) {
  GridGeometry g;
  g.size = {112, 60, 60};
  g.spacing = {0.3, 0.3, 0.3};
  const Vec3 a{12, 9, 9};
  const Vec3 b{22, 9, 9};
  Rng rng(5);
  Grid<float> hu(g);
  bone_voxels = 0;
  for (std::size_t i = 0; i < hu.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p{v.x * g.spacing.x, v.y * g.spacing.y, v.z * g.spacing.z};
    const Vec3 on_axis{std::clamp(p.x, a.x, b.x), a.y, a.z};
    const double depth = kRadius - distance(p, on_axis);
    const bool in_crack = std::abs(p.x - 13.4) < crack_mm / 2;
    hu[i] = depth < 0 ? 45.0F
                      : (in_crack      ? static_cast<float>(filling_hu)
                         : depth < 0.8 ? 1200.0F
                                       : 300.0F);
    bone_voxels += depth >= 0 && !in_crack ? 1U : 0U;
  }
  const Grid<float> blurred = gaussian_smooth(hu.view(), 0.25);
  Grid<std::int16_t> ct(g);
  for (std::size_t i = 0; i < hu.values().size(); ++i) {
    ct[i] =
        static_cast<std::int16_t>(std::lround(static_cast<double>(blurred[i]) + 25 * rng.normal()));
  }
  return ct;
}

TEST(BoneSegmentation, LosesNoPieceOfABoneThroughACrack) {
  for (const double filling : {45.0, 150.0}) {
    for (const double crack : {0.4, 0.55, 0.7, 0.9, 1.2, 1.8}) {
      std::size_t bone_voxels = 0;
      const Grid<std::int16_t> ct = cracked_bone(crack, filling, bone_voxels);
      const BoneSegmentation s = segment_bones(ct.view(), {}, no_progress);
      ASSERT_EQ(s.status, SegmentationStatus::Ok);
      std::size_t found = 0;
      for (const RegionLabel label : s.regions.values()) found += label != 0 ? 1U : 0U;
      EXPECT_GT(static_cast<double>(found), 0.93 * static_cast<double>(bone_voxels))
          << crack << " mm, " << filling << " HU, " << s.region_count << " regions";
    }
  }
}

TEST(BoneSegmentation, FindsABoneWithinAClosedSplint) {
  // Flesh of 40 cm^3 in a tube of plaster that runs through the scan, air around it, a bone inside.
  GridGeometry g;
  g.size = {70, 70, 60};
  g.spacing = {0.8, 0.8, 0.8};
  Grid<std::int16_t> ct(g);
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const double from_axis = 0.8 * std::hypot(v.x - 34.5, v.y - 34.5);
    const double depth = 7 - 0.8 * std::hypot(v.x - 34.5, v.y - 34.5, v.z - 29.5);
    ct[i] = from_axis > 24 ? -1000 : (from_axis > 20 ? 700 : 45);
    if (depth > 0) ct[i] = depth < 1.2 ? 1200 : 300;
  }
  const BoneSegmentation s = segment_bones(ct.view(), {}, no_progress);
  ASSERT_EQ(s.status, SegmentationStatus::Ok);
  const VoxelIndex middle{35 - s.offset.x, 35 - s.offset.y, 30 - s.offset.z};
  const RegionLabel bone = s.regions[middle];
  ASSERT_NE(bone, 0);
  const auto voxels = std::count(s.regions.values().begin(), s.regions.values().end(), bone);
  EXPECT_NEAR(static_cast<double>(voxels) * g.voxel_volume_mm3(), 4.0 / 3 * 3.1416 * 343, 200);
}

TEST(BoneSegmentation, IsTheSameEachTime) {
  const TwoBones scan = make_two_bones(0.4, 3);
  const BoneSegmentation a = segment_bones(scan.ct.view(), {}, no_progress);
  const BoneSegmentation b = segment_bones(scan.ct.view(), {}, no_progress);
  EXPECT_TRUE(
      std::equal(a.regions.values().begin(), a.regions.values().end(), b.regions.values().begin()));
}

TEST(BoneSegmentation, SaysWhenThereIsNoBone) {
  GridGeometry g;
  g.size = {20, 20, 20};
  Grid<std::int16_t> ct(g, 60);
  EXPECT_EQ(segment_bones(ct.view(), {}, no_progress).status, SegmentationStatus::NoBone);
  // A dense speck is not a bone either.
  ct[VoxelIndex{10, 10, 10}] = 3000;
  const BoneSegmentation s = segment_bones(ct.view(), {}, no_progress);
  EXPECT_EQ(s.status, SegmentationStatus::NoBone);
  EXPECT_EQ(s.region_count, 0);
}

}  // namespace
}  // namespace carpus::imaging
