// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/tissue_split.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "fluoroscopy/bone_phantom_test_support.hpp"
#include "fluoroscopy/ct_projector.hpp"

namespace carpus::fluoroscopy {
namespace {

/// Two balls whose rims touch, in muscle.
test::Phantom two_balls() {
  return test::make_phantom(61, 0.5, {test::ball({-4.2, 0, 0}, 4), test::ball({4.2, 1, 0}, 3.5)},
                            1000, test::box({0, 0, 0}, {30, 12, 12}), 50);
}

constexpr std::array<std::uint8_t, 2> kLabels{1, 2};

TEST(TissueSplit, LosesNothingAndCountsNothingTwice) {
  const test::Phantom p = two_balls();
  const TissueSplit split = split_tissue(p.ct.view(), p.labels.view(), kLabels);
  Grid<std::int16_t> sum = split.soft;
  for (const BodyPart& part : split.bodies) {
    for (std::size_t i = 0; i < part.units.values().size(); ++i) {
      const VoxelIndex v = part.units.geometry().index_of(i);
      const VoxelIndex at{v.x + part.box.low[0], v.y + part.box.low[1], v.z + part.box.low[2]};
      sum[at] = static_cast<std::int16_t>(sum[at] + part.units[i]);
    }
  }
  for (std::size_t i = 0; i < sum.values().size(); ++i) {
    ASSERT_EQ(sum[i], attenuation_units(p.ct[i])) << i;
  }
}

TEST(TissueSplit, LeavesSmoothSoftTissueWhereBonesWere) {
  const test::Phantom p = two_balls();
  const TissueSplit split = split_tissue(p.ct.view(), p.labels.view(), kLabels);
  const std::int16_t muscle = attenuation_units(50);
  for (int x = 0; x < 61; ++x) {
    for (int y = 20; y <= 40; ++y) {
      ASSERT_NEAR((split.soft[VoxelIndex{x, y, 30}]), muscle, 3) << x << "," << y;
    }
  }
}

TEST(TissueSplit, KeepsABodysGridWhereItsVoxelsWere) {
  const test::Phantom p = two_balls();
  const TissueSplit split = split_tissue(p.ct.view(), p.labels.view(), kLabels);
  const BodyPart& ball = split.bodies[1];
  const Vec3 centre = ball.units.geometry().voxel_from_patient({4.2, 1, 0});
  const VoxelIndex v{static_cast<int>(centre.x + 0.5), static_cast<int>(centre.y + 0.5),
                     static_cast<int>(centre.z + 0.5)};
  EXPECT_NEAR(ball.units[v], attenuation_units(1000) - attenuation_units(50), 3);
}

TEST(TissueSplit, TakesAirAroundABareBoneAsItsSoftTissue) {
  const test::Phantom p =
      test::make_phantom(41, 0.5, {test::ball({0, 0, 0}, 5)}, 1000, test::ball({0, 0, 0}, -1), 0);
  const TissueSplit split = split_tissue(p.ct.view(), p.labels.view(), {kLabels.data(), 1});
  for (const std::int16_t units : split.soft.values()) ASSERT_EQ(units, 0);
}

TEST(TissueSplit, GivesABodyWithoutVoxelsAnEmptyBox) {
  const test::Phantom p = two_balls();
  const std::array<std::uint8_t, 1> missing{9};
  const TissueSplit split = split_tissue(p.ct.view(), p.labels.view(), missing);
  EXPECT_TRUE(split.bodies[0].box.is_empty());
  for (std::size_t i = 0; i < p.ct.values().size(); ++i) {
    ASSERT_EQ(split.soft[i], attenuation_units(p.ct[i])) << "other labels are soft tissue";
  }
}

TEST(TissueSplit, RefusesALabelThatComesTwiceAndGridsThatDiffer) {
  const test::Phantom p = two_balls();
  const std::array<std::uint8_t, 2> twice{1, 1};
  EXPECT_THROW((void)split_tissue(p.ct.view(), p.labels.view(), twice), InvalidInput);
  GridGeometry g;
  g.size = {2, 2, 2};
  EXPECT_THROW((void)split_tissue(p.ct.view(), Grid<std::uint8_t>(g).view(), kLabels),
               InvalidInput);
}

}  // namespace
}  // namespace carpus::fluoroscopy
