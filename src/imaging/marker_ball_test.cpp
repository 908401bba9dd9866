// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/marker_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carpus::imaging {
namespace {

GridGeometry tilted_grid() {
  GridGeometry g;
  g.size = {20, 24, 12};
  g.spacing = {0.3, 0.4, 0.8};
  g.origin = {-5, 7, 100};
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  g.direction = Mat3::from_columns({c, s, 0}, {-s, c, 0}, {0, 0, 1});
  return g;
}

TEST(MarkerBall, HoldsTheVoxelsNearerThanItsRadius) {
  Grid<RegionLabel> labels(tilted_grid());
  const Vec3 centre = labels.geometry().patient_from_voxel({9.2, 11.7, 5.4});
  ASSERT_TRUE(paint_ball({7, centre, 1.5}, labels.view()));
  int inside = 0;
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const VoxelIndex v = labels.geometry().index_of(i);
    const Vec3 p = labels.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    EXPECT_EQ(labels[i], distance(p, centre) <= 1.5 ? 7 : 0);
    inside += labels[i] == 7 ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
}

TEST(MarkerBall, WithoutRadiusIsOneVoxelAndNoneBeyondTheGrid) {
  Grid<RegionLabel> labels(tilted_grid());
  const GridGeometry& g = labels.geometry();
  EXPECT_TRUE(paint_ball({3, g.patient_from_voxel({-0.4, 23.4, 0}), 0}, labels.view()));
  EXPECT_EQ(labels[(VoxelIndex{0, 23, 0})], 3);
  for (const Vec3& beyond : {Vec3{-0.6, 3, 3}, Vec3{3, 24, 3}, Vec3{3, 3, 1e300}}) {
    EXPECT_FALSE(paint_ball({4, g.patient_from_voxel(beyond), 50}, labels.view()));
  }
  EXPECT_FALSE(paint_ball({4, {std::numeric_limits<double>::quiet_NaN(), 0, 0}, 1}, labels.view()));
  EXPECT_EQ(std::count(labels.values().begin(), labels.values().end(), RegionLabel{0}),
            static_cast<std::ptrdiff_t>(labels.values().size()) - 1);
}

TEST(MarkerBall, AsLargeAsTheGridFillsIt) {
  Grid<RegionLabel> labels(tilted_grid());
  ASSERT_TRUE(paint_ball({1, labels.geometry().patient_from_voxel({9, 9, 5}), 1e9}, labels.view()));
  EXPECT_EQ(std::count(labels.values().begin(), labels.values().end(), RegionLabel{1}),
            static_cast<std::ptrdiff_t>(labels.values().size()));
}

}  // namespace
}  // namespace carpus::imaging
