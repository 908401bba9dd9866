// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/marching_cubes.hpp"
#include "soft_tissue/detail/lay_cartilage.hpp"

namespace carpus::soft_tissue::detail {
namespace {

constexpr double kRadiusMm = 10;

TriangleMesh ball() {
  GridGeometry g;
  g.size = {34, 34, 34};
  g.spacing = {0.7, 0.7, 0.7};
  g.origin = {-11.55, -11.55, -11.55};
  Grid<float> values(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    values[i] = static_cast<float>(
        kRadiusMm - length(g.patient_from_voxel({double(v.x), double(v.y), double(v.z)})));
  }
  return mesh::extract_isosurface(values.view(), 0.0);
}

TEST(RaisedSheet, CapOfABallIsClosedAndHasItsVolume) {
  const TriangleMesh surface = ball();
  std::vector<double> level;
  for (const Vec3& v : surface.vertices) level.push_back(v.z - 4);
  const std::vector<float> thickness(level.size(), 0.5F);
  const TriangleMesh sheet = raised_sheet(surface, level, thickness);
  EXPECT_EQ(check_surface(sheet), SurfaceStatus::Ok);
  const double outer = std::pow(kRadiusMm + 0.5, 3) - std::pow(kRadiusMm, 3);
  const double cap = 2.0 / 3.0 * std::numbers::pi * outer * (1 - 4 / kRadiusMm);
  EXPECT_NEAR(volume_of(sheet), cap, 0.06 * cap);  // the rim is thin
}

TEST(RaisedSheet, NothingToRaiseIsEmpty) {
  const TriangleMesh surface = ball();
  const std::vector<double> level(surface.vertices.size(), -1);
  EXPECT_TRUE(raised_sheet(surface, level, std::vector<float>(level.size())).facets.empty());
}

}  // namespace
}  // namespace carpus::soft_tissue::detail
