// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/genus.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/marching_cubes.hpp"
#include "mesh/smooth.hpp"

namespace carpus::mesh {
namespace {

/// A ball or a ring of voxels of 0.5 mm.
TriangleMesh body(bool is_ring) {
  GridGeometry g;
  g.size = {40, 40, 24};
  g.spacing = {0.5, 0.5, 0.5};
  Grid<float> values(g);
  for (std::size_t i = 0; i < values.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p{v.x * 0.5 - 10, v.y * 0.5 - 10, v.z * 0.5 - 6};
    const double from_ring = std::hypot(std::hypot(p.x, p.y) - 6, p.z);
    values[i] = static_cast<float>(is_ring ? 2.5 - from_ring : 5 - length(p));
  }
  return extract_isosurface(values.view(), 0);
}

TEST(Genus, TellsARingFromABall) {
  EXPECT_EQ(genus_of(body(false)), 0);
  EXPECT_EQ(genus_of(body(true)), 1);
}

TEST(Smooth, MovesNoVertexFartherThanItsBound) {
  const TriangleMesh rough = body(true);
  SmoothOptions options;
  options.iterations = 30;
  options.max_displacement_mm = 0.05;
  const TriangleMesh bounded = smooth(rough, options);
  options.max_displacement_mm = 0;
  const TriangleMesh free = smooth(rough, options);
  double farthest = 0;
  double farthest_free = 0;
  for (std::size_t v = 0; v < rough.vertices.size(); ++v) {
    farthest = std::max(farthest, distance(rough.vertices[v], bounded.vertices[v]));
    farthest_free = std::max(farthest_free, distance(rough.vertices[v], free.vertices[v]));
  }
  EXPECT_LE(farthest, 0.05 + 1e-12);
  EXPECT_GT(farthest_free, 0.05);
  EXPECT_NEAR(volume_of(bounded), volume_of(rough), 0.01 * volume_of(rough));
}

}  // namespace
}  // namespace carpus::mesh
