// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/part_bridges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "mesh/genus.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

constexpr double kBridgeAtMm = 3.0;

/// A flat round space with two bridges across it, one of 1 mm and one of 0.7, and how high each
/// vertex lies in it.
struct Bridged {
  TriangleMesh surface;
  std::vector<float> level;
};

Bridged bridged() {
  GridGeometry g;
  g.size = {50, 50, 16};
  g.spacing = {0.4, 0.4, 0.4};
  Grid<float> values(g);
  const auto at = [](const VoxelIndex& v) {
    return Vec3{v.x * 0.4 - 9.8, v.y * 0.4 - 9.8, v.z * 0.4 - 3};
  };
  for (std::size_t i = 0; i < values.values().size(); ++i) {
    const Vec3 p = at(g.index_of(i));
    const double out = std::max({std::hypot(p.x, p.y) - 7.5, std::abs(p.z) - 1.1,
                                 1.0 - std::hypot(p.x - kBridgeAtMm, p.y),
                                 0.7 - std::hypot(p.x + kBridgeAtMm, p.y)});
    values[i] = static_cast<float>(-out);
  }
  Bridged made;
  made.surface = extract_isosurface(values.view(), 0);
  for (const Vec3& v : made.surface.vertices)
    made.level.push_back(static_cast<float>(0.5 + (v.z - 3) / 2.4));
  return made;
}

TriangleMesh surface_of(const Bridged& from, const PartedBridges& parted) {
  TriangleMesh made{from.surface.vertices, parted.facets};
  for (const CutVertex& c : parted.cuts) {
    const Vec3 a = from.surface.vertices[c.a];
    made.vertices.push_back(a + (from.surface.vertices[c.b] - a) * c.share);
  }
  return made;
}

bool spans_nothing(std::uint32_t) { return false; }

TEST(PartBridges, CutsEachThroughAndLeavesAClosedSurfaceWithoutHandles) {
  const Bridged from = bridged();
  ASSERT_EQ(genus_of(from.surface), 2);
  const PartedBridges parted =
      part_bridges(from.surface.vertices, from.surface.facets, from.level, spans_nothing);
  EXPECT_EQ(parted.bridges, 2U);
  const TriangleMesh surface = surface_of(from, parted);
  EXPECT_EQ(check_surface(surface), SurfaceStatus::Ok);
  EXPECT_EQ(genus_of(surface), 0);
  EXPECT_NEAR(volume_of(surface), volume_of(from.surface), 1e-9);
}

TEST(PartBridges, MovedApartTheSidesHangTogetherAtTheRimAlone) {
  const Bridged from = bridged();
  const PartedBridges parted =
      part_bridges(from.surface.vertices, from.surface.facets, from.level, spans_nothing);
  const TriangleMesh surface = surface_of(from, parted);
  const std::size_t count = from.level.size();
  const auto is_high = [&](std::uint32_t v) {
    return from.level[v < count ? v : parted.cuts[v - count].a] >= 0.5F;
  };
  std::size_t across = 0;
  for (const Triangle& t : surface.facets) {
    if (is_high(t[0]) == is_high(t[1]) && is_high(t[0]) == is_high(t[2])) continue;
    ++across;
    for (const std::uint32_t v : t) {
      const Vec3& p = surface.vertices[v];
      EXPECT_GT(std::hypot(p.x - 9.8, p.y - 9.8), 6.5);
    }
  }
  EXPECT_GT(across, 50U);
}

TEST(PartBridges, WhatTrulyGoesAcrossStays) {
  const Bridged from = bridged();
  const auto is_first = [&](std::uint32_t v) { return from.surface.vertices[v].x > 9.8; };
  const PartedBridges parted =
      part_bridges(from.surface.vertices, from.surface.facets, from.level, is_first);
  EXPECT_EQ(parted.bridges, 1U);
  EXPECT_EQ(genus_of(surface_of(from, parted)), 1);
}

TEST(PartBridges, ASurfaceWithoutAnyStaysAsItIs) {
  Bridged from = bridged();
  for (float& level : from.level) level = 0;
  const PartedBridges none =
      part_bridges(from.surface.vertices, from.surface.facets, from.level, spans_nothing);
  EXPECT_EQ(none.bridges, 0U);
  EXPECT_EQ(none.facets, from.surface.facets);
}

TEST(PartBridges, AsksForALevelForEachVertex) {
  Bridged from = bridged();
  from.level.pop_back();
  EXPECT_THROW(
      (void)part_bridges(from.surface.vertices, from.surface.facets, from.level, spans_nothing),
      InvalidInput);
}

}  // namespace
}  // namespace carpus::mesh
