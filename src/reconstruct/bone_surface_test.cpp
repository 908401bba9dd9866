// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/bone_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "fields/triangle_tree.hpp"
#include "reconstruct/skin_surface.hpp"

namespace carpus::reconstruct {
namespace {

/// A ball, or the part of it in the grid, as label 3, with the measure that a CT would give.
struct Ball {
  Grid<std::uint8_t> labels;
  Grid<float> excess;
};

Ball make_ball(const Vec3& centre, double radius, const GridGeometry& g) {
  Ball ball{Grid<std::uint8_t>(g), Grid<float>(g)};
  for (std::size_t i = 0; i < ball.labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const double depth = radius - distance(p, centre);
    ball.labels[i] = depth > 0 ? 3 : 0;
    ball.excess[i] = static_cast<float>(std::clamp(depth / 1.2, -0.5, 0.5));
  }
  return ball;
}

GridGeometry grid_of(int n, double slice_mm) {
  GridGeometry g;
  g.size = {n, n, static_cast<int>(n * 0.4 / slice_mm)};
  g.spacing = {0.4, 0.4, slice_mm};
  g.origin = {-30, 12, 5};
  return g;
}

TEST(BoneSurface, FollowsTheDensityBetweenVoxels) {
  constexpr double kRadius = 6.13;
  const GridGeometry g = grid_of(44, 0.6);
  const Vec3 centre = g.origin + Vec3{8.71, 8.64, 8.8};
  const Ball ball = make_ball(centre, kRadius, g);
  const BoneField field = build_bone_field(ball.labels.view(), 3, ball.excess.view());
  const TriangleMesh surface = build_bone_surface(field);
  EXPECT_EQ(check_surface(surface), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(surface) / (4.0 / 3 * kPi * kRadius * kRadius * kRadius), 1.0, 0.02);
  double worst = 0;
  for (const Vec3& p : surface.vertices) {
    worst = std::max(worst, std::abs(distance(p, centre) - kRadius));
  }
  EXPECT_LT(worst, 0.15);  // a quarter of the slice spacing; label steps alone would give 0.3
  EXPECT_GE(surface.facets.size(), 2500U);
  EXPECT_LE(surface.facets.size(), 10000U);
}

TEST(BoneSurface, ClosesABoneThatLeavesTheScan) {
  const GridGeometry g = grid_of(40, 0.4);
  const Vec3 centre = g.patient_from_voxel({20, 20, 39});
  const Ball half = make_ball(centre, 6, g);
  const BoneField field = build_bone_field(half.labels.view(), 3, half.excess.view());
  const TriangleMesh surface = build_bone_surface(field);
  EXPECT_EQ(check_surface(surface), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(surface) / (2.0 / 3 * kPi * 216), 1.0, 0.08);
}

/// Against an oracle that asks every facet, on a ball of so few facets that they cut deep.
TEST(BoneSurface, MeasuresHowFarItsSimplificationMovedIt) {
  const GridGeometry g = grid_of(40, 0.5);
  const Ball ball = make_ball(g.patient_from_voxel({20, 20, 20}), 7, g);
  const BoneField field = build_bone_field(ball.labels.view(), 3, ball.excess.view());
  BoneSurfaceOptions options;
  options.least_facets = 200;
  options.facets_per_mm2 = 0;
  options.max_error_mm = 0.6;
  double error_mm = -1;
  const auto few = build_bone_surface(field, options, &error_mm);
  options.least_facets = options.most_facets = 1000000;
  double none_mm = -1;
  const auto all = build_bone_surface(field, options, &none_mm);
  EXPECT_EQ(none_mm, 0);
  ASSERT_LT(few.facets.size(), all.facets.size() / 8);
  double farthest = 0;
  for (const Vec3& vertex : all.vertices) {
    double nearest = 1e9;
    for (const Triangle& t : few.facets) {
      nearest = std::min(nearest, distance(vertex, fields::nearest_point_on_triangle(
                                                       vertex, few.vertices[t[0]],
                                                       few.vertices[t[1]], few.vertices[t[2]])));
    }
    farthest = std::max(farthest, nearest);
  }
  EXPECT_GT(error_mm, 0.02);
  EXPECT_NEAR(error_mm, farthest, 1e-9);
}

TEST(BoneSurface, OfAMissingLabelIsEmpty) {
  const Grid<std::uint8_t> labels(grid_of(10, 0.4));
  const Grid<float> excess(labels.geometry());
  const BoneField field = build_bone_field(labels.view(), 3, excess.view());
  EXPECT_TRUE(build_bone_surface(field).facets.empty());
}

TEST(LabelByFields, GivesEachVoxelToTheSurfaceThatHoldsIt) {
  const GridGeometry g = grid_of(44, 0.4);
  const Vec3 centre = g.origin + Vec3{8.6, 8.6, 8.6};
  const Ball ball = make_ball(centre, 5, g);
  const std::vector<BoneField> fields{build_bone_field(ball.labels.view(), 3, ball.excess.view())};
  Grid<std::uint8_t> labels(g, 9);
  label_by_fields(fields, std::vector<std::uint8_t>{3}, labels.view());
  std::size_t differing = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    inside += ball.labels[i] == 3 ? 1 : 0;
    differing += labels[i] != ball.labels[i] ? 1 : 0;
    ASSERT_TRUE(labels[i] == 0 || labels[i] == 3);
  }
  EXPECT_LT(differing, inside / 50);
}

TEST(LargestPiece, DropsTheSmallerOneAndItsVertices) {
  const TriangleMesh small{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  TriangleMesh both = small;
  for (const Vec3& p : small.vertices) both.vertices.push_back(Vec3{10, 0, 0} + 2 * p);
  for (Triangle t : small.facets) {
    for (std::uint32_t& v : t) v += 4;
    both.facets.push_back(t);
  }
  const TriangleMesh kept = largest_piece(both);
  EXPECT_EQ(kept.vertices.size(), 4U);
  EXPECT_NEAR(volume_of(kept), 8.0 / 6, 1e-12);
}

TEST(SkinSurface, IsATubeThatIsOpenWhereTheLimbLeavesTheScan) {
  GridGeometry g;
  g.size = {80, 80, 60};
  g.spacing = {0.5, 0.5, 0.5};
  Grid<std::int16_t> ct(g, -1000);
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (std::hypot(v.x - 40, v.y - 40) * 0.5 < 12) ct[i] = 40;
  }
  const MeshIn<frame::Patient> skin = build_skin_surface(ct.view());
  ASSERT_FALSE(skin.facets.empty());
  EXPECT_EQ(check_surface(skin), SurfaceStatus::OpenOrNonManifold);
  EXPECT_NEAR(area_of(skin) / (2 * kPi * 12 * 30), 1.0, 0.08);
  for (const Vec3& p : skin.vertices) {
    if (p.z < 1.5 || p.z > 28) continue;  // the rims are bevelled where the caps were cut off
    EXPECT_NEAR(std::hypot(p.x - 20, p.y - 20), 12.0, 0.6);
  }
  EXPECT_TRUE(build_skin_surface(Grid<std::int16_t>(g, -1000).view()).facets.empty());

  // Trimmed, it ends in two straight edges, without the bevels.
  const TriangleMesh trimmed = trimmed_skin(skin, g);
  double low = 100;
  double high = -100;
  for (const Vec3& p : trimmed.vertices) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
    EXPECT_NEAR(std::hypot(p.x - 20, p.y - 20), 12.0, 0.6);
  }
  EXPECT_NEAR(low, 1.8, 1e-9);
  EXPECT_NEAR(high, 59 * 0.5 - 1.8, 1e-9);
  EXPECT_NEAR(area_of(trimmed) / (2 * kPi * 12 * (high - low)), 1.0, 0.02);
}

TEST(SkinSurface, TrimmingKeepsTheLargestPieceOnly) {
  MeshIn<frame::Patient> skin(TriangleMesh{{{10, 10, -5}, {20, 10, 40}, {10, 20, 40}, {10, 10, 40}},
                                           {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  const std::size_t alone =
      trimmed_skin(skin, GridGeometry{{80, 80, 60}, {0.5, 0.5, 0.5}}).facets.size();
  skin.vertices.insert(skin.vertices.end(), {{30, 30, 15}, {31, 30, 15}, {30, 31, 15}});
  skin.facets.push_back({4, 5, 6});
  EXPECT_EQ(trimmed_skin(skin, GridGeometry{{80, 80, 60}, {0.5, 0.5, 0.5}}).facets.size(), alone);
}

}  // namespace
}  // namespace carpus::reconstruct
