// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/trilinear.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace carpus {
namespace {

/// Values 2 x - 3 y + 5 z + 7 of the voxel's indices.
Grid<float> linear_grid() {
  GridGeometry geometry;
  geometry.size = {4, 3, 5};
  geometry.spacing = {0.5, 2, 1};
  geometry.origin = {10, 20, 30};
  Grid<float> grid(geometry);
  for (std::size_t i = 0; i < grid.values().size(); ++i) {
    const VoxelIndex v = geometry.index_of(i);
    grid[i] = static_cast<float>(2 * v.x - 3 * v.y + 5 * v.z + 7);
  }
  return grid;
}

TEST(Trilinear, ReadsALinearFunctionExactlyUpToItsBorders) {
  const Grid<float> grid = linear_grid();
  const GridView<const float> view = grid.view();
  Rng rng(7);
  for (int i = 0; i < 200; ++i) {
    const auto place = [&](double last) { return rng.below(3) == 0 ? last : rng.uniform(0, last); };
    const Vec3 p{place(3), place(2), place(4)};
    const double truth = 2 * p.x - 3 * p.y + 5 * p.z + 7;
    EXPECT_NEAR(sample_trilinear(view, p, -1), truth, 1e-12);
    EXPECT_NEAR(sample_at(view, grid.geometry().patient_from_voxel(p), truth), truth, 1e-12);
    const Vec3 slope = TrilinearCell(grid, p).slope();
    EXPECT_NEAR(distance(slope, {2, -3, 5}), 0, 1e-12);
  }
}

TEST(Trilinear, SaysOutsideBeyondVoxelCentresAndForNaN) {
  const Grid<float> grid = linear_grid();
  for (const Vec3& p :
       {Vec3{-1e-9, 1, 1}, Vec3{1, 2.1, 1}, Vec3{1, 1, 4.1}, Vec3{std::nan(""), 1, 1}}) {
    EXPECT_EQ(sample_trilinear(grid.view(), p, -1000), -1000);
  }
}

TEST(Trilinear, ReadsAGridOfOneVoxelThick) {
  GridGeometry geometry;
  geometry.size = {2, 1, 1};
  const Grid<float> grid(geometry, {1, 3});
  EXPECT_EQ(sample_trilinear(grid.view(), {0.25, 0, 0}, -1), 1.5);
  EXPECT_EQ(TrilinearCell(grid, {1, 0, 0}).slope(), (Vec3{2, 0, 0}));
}

TEST(VoxelAt, IsTheNearestVoxelAsFarAsItsFaces) {
  const Grid<float> grid = linear_grid();
  const auto at = [&](const Vec3& voxel) {
    return voxel_at(grid, grid.geometry().patient_from_voxel(voxel), -1000.0F);
  };
  EXPECT_EQ(at({1.4, 0.6, 2.4}), 2 - 3 + 10 + 7);
  EXPECT_EQ(at({-0.4, 2.4, 4.4}), -6 + 20 + 7);
  EXPECT_EQ(at({-0.6, 1, 1}), -1000);
  EXPECT_EQ(at({1, 1, 4.6}), -1000);
}

}  // namespace
}  // namespace carpus
