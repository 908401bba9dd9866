// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/smooth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

/// A ball of voxels 0 or 1: as stepped as a surface can be.
TriangleMesh stepped_ball(double radius_mm) {
  Grid<float> field(GridGeometry{{41, 41, 41}, {0.5, 0.5, 0.5}, {-10, -10, -10}, {}});
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = field.geometry().index_of(i);
    const Vec3 p{v.x * 0.5 - 10, v.y * 0.5 - 10, v.z * 0.5 - 10};
    field[i] = length(p) <= radius_mm ? 1.0F : 0.0F;
  }
  return extract_isosurface(field.view(), 0.5);
}

double radial_deviation(const TriangleMesh& mesh) {
  double sum = 0;
  double squares = 0;
  for (const Vec3& v : mesh.vertices) {
    sum += length(v);
    squares += dot(v, v);
  }
  const auto n = static_cast<double>(mesh.vertices.size());
  return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
}

TEST(Smooth, TakesTheStepsOffABallAndKeepsItsVolume) {
  const TriangleMesh before = stepped_ball(8);
  const TriangleMesh after = smooth(before);
  EXPECT_EQ(check_surface(after), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(after) / volume_of(before), 1, 1e-12);
  EXPECT_LT(radial_deviation(after), 0.6 * radial_deviation(before));
  EXPECT_LT(area_of(after), area_of(before));
  EXPECT_NEAR(area_of(after) / (4 * kPi * 64), 1, 0.04);
}

TEST(Smooth, KeepsVolumeByItselfToOnePercent) {
  const TriangleMesh before = stepped_ball(5);
  SmoothOptions options;
  options.restores_volume = false;
  EXPECT_NEAR(volume_of(smooth(before, options)) / volume_of(before), 1, 0.01);
}

TEST(Smooth, LeavesAnEmptyMeshEmptyAndRefusesAShrinkingFilter) {
  EXPECT_TRUE(smooth({}).vertices.empty());
  SmoothOptions options;
  options.mu = -0.1;
  EXPECT_THROW((void)smooth({}, options), InvalidInput);
}

}  // namespace
}  // namespace carpus::mesh
