// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/marching_cubes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "mesh/normals.hpp"

namespace carpus::mesh {
namespace {

/// Radius minus distance from the origin, so that the body is a ball.
Grid<float> ball_field(const GridGeometry& geometry, double radius_mm) {
  Grid<float> field(geometry);
  for (std::size_t i = 0; i < geometry.voxel_count(); ++i) {
    const VoxelIndex v = geometry.index_of(i);
    const Vec3 p = geometry.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    field[i] = static_cast<float>(radius_mm - length(p));
  }
  return field;
}

GridGeometry centred_cube(int n, double half_width_mm) {
  const double spacing = 2 * half_width_mm / (n - 1);
  return {{n, n, n},
          {spacing, spacing, spacing},
          {-half_width_mm, -half_width_mm, -half_width_mm},
          Mat3::identity()};
}

double ball_volume_error(int n) {
  const TriangleMesh mesh = extract_isosurface(ball_field(centred_cube(n, 12), 10).view(), 0);
  EXPECT_EQ(check_surface(mesh), SurfaceStatus::Ok);
  return volume_of(mesh) / (4.0 / 3.0 * kPi * 1000.0) - 1;
}

TEST(MarchingCubes, ConvergesToTheVolumeAndAreaOfABall) {
  const double coarse = std::abs(ball_volume_error(13));
  const double fine = std::abs(ball_volume_error(49));
  EXPECT_LT(fine, 0.002);
  EXPECT_LT(fine, coarse / 8);  // second order: 16 times less is expected
  const TriangleMesh mesh = extract_isosurface(ball_field(centred_cube(49, 12), 10).view(), 0);
  EXPECT_NEAR(area_of(mesh) / (4 * kPi * 100), 1, 0.005);
}

TEST(MarchingCubes, FollowsSpacingOriginAndDirectionOfEitherHandedness) {
  GridGeometry geometry = centred_cube(30, 12);
  geometry.size = {49, 33, 25};
  geometry.spacing = {0.5, 0.75, 1.0};
  const double s = std::sqrt(0.5);
  for (const double handed : {1.0, -1.0}) {
    geometry.direction = Mat3::from_columns({s, s, 0}, {-s, s, 0}, {0, 0, handed});
    geometry.origin = {};
    geometry.origin = -geometry.patient_from_voxel({24, 16, 12});
    const TriangleMesh mesh = extract_isosurface(ball_field(geometry, 10).view(), 0);
    ASSERT_EQ(check_surface(mesh), SurfaceStatus::Ok);
    EXPECT_NEAR(volume_of(mesh) / (4.0 / 3.0 * kPi * 1000.0), 1, 0.01) << handed;
    for (const Vec3& v : mesh.vertices) EXPECT_NEAR(length(v), 10, 0.06);
  }
}

TEST(MarchingCubes, IsAClosedManifoldForAnyValues) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    Rng rng(seed);
    const auto side = [&] { return static_cast<int>(1 + rng.below(6)); };
    const GridGeometry geometry{{side(), side(), side()}, {0.4, 0.5, 0.9}, {3, 2, 1}, {}};
    Grid<float> field(geometry);
    const std::uint64_t kind = rng.below(4);
    for (float& value : field.values()) {
      value = static_cast<float>(rng.uniform(-1, 1));
      if (kind == 1) value = value > 0 ? 1.0F : -1.0F;                 // masks
      if (kind == 2) value = static_cast<float>(rng.below(3)) - 1.0F;  // exact hits of iso
      if (kind == 3 && rng.below(8) == 0) value = std::numeric_limits<float>::quiet_NaN();
    }
    const TriangleMesh mesh = extract_isosurface(field.view(), 0);
    if (mesh.facets.empty()) continue;
    ASSERT_EQ(check_surface(mesh), SurfaceStatus::Ok) << "seed " << seed;
    ASSERT_GT(volume_of(mesh), 0) << "seed " << seed;
  }
}

TEST(MarchingCubes, MeetsEveryPairOfNeighbouringConfigurations) {
  // Two cubes that share a face: all 4096 sign patterns, hence every pair of readings of that face.
  for (unsigned pattern = 1; pattern < 4096; ++pattern) {
    Grid<float> field(GridGeometry{{3, 2, 2}, {1, 1, 1}, {}, {}});
    for (std::size_t i = 0; i < 12; ++i) field[i] = (pattern >> i & 1U) != 0 ? 1.0F : -1.0F;
    ASSERT_EQ(check_surface(extract_isosurface(field.view(), 0)), SurfaceStatus::Ok) << pattern;
  }
}

TEST(MarchingCubes, ClosesOneVoxelAndABodyThatFillsTheGrid) {
  const Grid<float> one(GridGeometry{{1, 1, 1}, {1, 1, 1}, {}, {}}, 1.0F);
  const TriangleMesh octahedron = extract_isosurface(one.view(), 0);
  EXPECT_EQ(check_surface(octahedron), SurfaceStatus::Ok);
  EXPECT_EQ(octahedron.facets.size(), 8U);
  const Grid<float> block(GridGeometry{{4, 5, 6}, {1, 1, 1}, {}, {}}, 1.0F);
  EXPECT_EQ(check_surface(extract_isosurface(block.view(), 0)), SurfaceStatus::Ok);
  EXPECT_TRUE(extract_isosurface(block.view(), 0, {.close_at_border = false}).facets.empty());
  EXPECT_TRUE(extract_isosurface(block.view(), 2).facets.empty());
}

TEST(MarchingCubes, RefusesAnIsoValueThatIsNotANumber) {
  const Grid<float> one(GridGeometry{{1, 1, 1}, {1, 1, 1}, {}, {}}, 1.0F);
  EXPECT_THROW((void)extract_isosurface(one.view(), std::nan("")), InvalidInput);
  EXPECT_THROW((void)extract_isosurface(Grid<float>().view(), 0), InvalidInput);
}

TEST(Normals, PointAwayFromABall) {
  const Grid<float> field = ball_field(centred_cube(33, 12), 10);
  const TriangleMesh mesh = extract_isosurface(field.view(), 0);
  const std::vector<Vec3> from_field = gradient_normals<float>(field.view(), mesh.vertices);
  const std::vector<Vec3> from_facets = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 outward = mesh.vertices[i] / length(mesh.vertices[i]);
    EXPECT_GT(dot(from_field[i], outward), 0.999);
    EXPECT_GT(dot(from_facets[i], outward), 0.95);
  }
}

}  // namespace
}  // namespace carpus::mesh
