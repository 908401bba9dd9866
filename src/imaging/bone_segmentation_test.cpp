// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/bone_segmentation.hpp"

#include <gtest/gtest.h>

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
