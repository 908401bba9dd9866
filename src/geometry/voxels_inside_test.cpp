// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/voxels_inside.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace carpus {
namespace {

/// Appends a box; inside out where `turn` is false.
void add_box(TriangleMesh& mesh, const Vec3& low, const Vec3& high, bool turn = true) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                             (i & 4U) != 0 ? high.z : low.z});
  }
  constexpr std::array<Triangle, 12> kFacets{{{0, 2, 1},
                                              {1, 2, 3},
                                              {4, 5, 6},
                                              {5, 7, 6},
                                              {0, 1, 4},
                                              {1, 5, 4},
                                              {2, 6, 3},
                                              {3, 6, 7},
                                              {0, 4, 2},
                                              {2, 4, 6},
                                              {1, 3, 5},
                                              {3, 7, 5}}};
  for (Triangle t : kFacets) {
    if (!turn) std::swap(t[1], t[2]);
    mesh.facets.push_back({base + t[0], base + t[1], base + t[2]});
  }
}

std::ptrdiff_t count_inside(const TriangleMesh& mesh) {
  GridGeometry grid;
  grid.size = {12, 12, 12};
  const Grid<std::uint8_t> inside = voxels_inside(mesh, grid);
  return std::count(inside.values().begin(), inside.values().end(), 1);
}

TEST(VoxelsInside, CountsWhatABoxHolds) {
  TriangleMesh mesh;
  add_box(mesh, {1.5, 2.5, 3.5}, {4.5, 4.5, 4.5});
  EXPECT_EQ(volume_of(mesh), 6);
  EXPECT_EQ(count_inside(mesh), 6);
}

TEST(VoxelsInside, RowsThroughVerticesAndEdgesGoInAsOftenAsOut) {
  TriangleMesh mesh;
  add_box(mesh, {1, 2, 3}, {4, 4, 4});  // its faces lie on voxel centres: one of each two counts
  EXPECT_EQ(count_inside(mesh), 3 * 2 * 1);
}

TEST(VoxelsInside, ACavityIsOutsideAndAnOverlapIsInside) {
  TriangleMesh mesh;
  add_box(mesh, {0.5, 0.5, 0.5}, {5.5, 5.5, 5.5});
  add_box(mesh, {1.5, 1.5, 1.5}, {3.5, 3.5, 3.5}, false);
  EXPECT_EQ(count_inside(mesh), 125 - 8);
  add_box(mesh, {4.5, 4.5, 4.5}, {6.5, 6.5, 6.5});  // shares one voxel with the first
  EXPECT_EQ(count_inside(mesh), 125 - 8 + 7);
}

TEST(VoxelsInside, WhatLiesBeyondTheGridIsCutOff) {
  TriangleMesh mesh;
  add_box(mesh, {-5, -5, -5}, {0.5, 0.5, 0.5});
  add_box(mesh, {10.5, 10.5, 10.5}, {30, 30, 30});
  EXPECT_EQ(count_inside(mesh), 2);
}

}  // namespace
}  // namespace carpus
