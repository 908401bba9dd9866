// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/simplify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

TriangleMesh ball(double radius_mm) {
  Grid<float> field(GridGeometry{{41, 41, 41}, {0.5, 0.5, 0.5}, {90, -10, -10}, {}});
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = field.geometry().index_of(i);
    const Vec3 p{v.x * 0.5 - 10, v.y * 0.5 - 10, v.z * 0.5 - 10};
    field[i] = static_cast<float>(radius_mm - length(p));
  }
  return extract_isosurface(field.view(), 0);
}

TEST(Simplify, ReachesTheTargetWithinTheErrorAndStaysClosed) {
  const TriangleMesh before = ball(8);
  const SimplifyResult result = simplify(before, {.target_facets = 1000, .max_error_mm = 0.2});
  EXPECT_EQ(check_surface(result.mesh), SurfaceStatus::Ok);
  EXPECT_LE(result.mesh.facets.size(), 1010U);
  EXPECT_LE(result.error_mm, 0.2);
  EXPECT_NEAR(volume_of(result.mesh) / volume_of(before), 1, 0.02);
  for (const Vec3& v : result.mesh.vertices) EXPECT_NEAR(distance(v, {100, 0, 0}), 8, 0.05);
}

TEST(Simplify, StopsAtTheErrorBeforeTheTarget) {
  const TriangleMesh before = ball(8);
  const SimplifyResult fine = simplify(before, {.target_facets = 4, .max_error_mm = 0.02});
  const SimplifyResult coarse = simplify(before, {.target_facets = 4, .max_error_mm = 0.5});
  EXPECT_LE(fine.error_mm, 0.02 * 1.0001);
  EXPECT_LT(coarse.mesh.facets.size(), fine.mesh.facets.size());
  EXPECT_EQ(check_surface(fine.mesh), SurfaceStatus::Ok);
  EXPECT_EQ(check_surface(coarse.mesh), SurfaceStatus::Ok);
}

TEST(Simplify, NeverLeavesTheManifoldsOnRuggedSurfaces) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng(seed);
    Grid<float> field(GridGeometry{{7, 7, 7}, {0.5, 0.5, 0.5}, {}, {}});
    for (float& value : field.values()) value = static_cast<float>(rng.uniform(-1, 1));
    const TriangleMesh before = extract_isosurface(field.view(), 0);
    const SimplifyResult result = simplify(before, {.target_facets = 50, .max_error_mm = 2});
    ASSERT_EQ(check_surface(result.mesh), SurfaceStatus::Ok) << "seed " << seed;
    ASSERT_LE(result.mesh.facets.size(), before.facets.size());
  }
}

TEST(Simplify, KeepsWhatIsAlreadySmallAndRefusesAnErrorOfZero) {
  const TriangleMesh before = ball(1);
  EXPECT_EQ(simplify(before, {.target_facets = 100000}).mesh.facets, before.facets);
  EXPECT_THROW((void)simplify(before, {.target_facets = 4, .max_error_mm = 0}), InvalidInput);
}

}  // namespace
}  // namespace carpus::mesh
