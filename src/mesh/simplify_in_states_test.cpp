// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/simplify_in_states.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

TriangleMesh isosurface(int size, double spacing_mm, const auto& value) {
  Grid<float> field(
      GridGeometry{{size, size, size}, {spacing_mm, spacing_mm, spacing_mm}, {90, -10, -10}, {}});
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = field.geometry().index_of(i);
    field[i] = static_cast<float>(
        value(Vec3{v.x * spacing_mm, v.y * spacing_mm, v.z * spacing_mm} - Vec3{10, 10, 10}));
  }
  return extract_isosurface(field.view(), 0);
}

TriangleMesh ball(double radius_mm) {
  return isosurface(41, 0.5, [&](const Vec3& p) { return radius_mm - length(p); });
}

TriangleMesh mesh_of(const InStates& result, const std::vector<Vec3>& places) {
  TriangleMesh mesh;
  for (const std::uint32_t v : result.kept) mesh.vertices.push_back(places[v]);
  mesh.facets = result.facets;
  return mesh;
}

TEST(SimplifyInStates, ReachesTheTargetAndKeepsABallClosedAndRound) {
  const TriangleMesh before = ball(8);
  const InStates result = simplify_in_states(before.facets, std::array{before.vertices}, 1000);
  const TriangleMesh after = mesh_of(result, before.vertices);
  EXPECT_EQ(check_surface(after), SurfaceStatus::Ok);
  EXPECT_EQ(after.facets.size(), 1000U);
  EXPECT_LT(result.error_mm, 0.1);
  EXPECT_NEAR(volume_of(after) / volume_of(before), 1, 0.02);
}

TEST(SimplifyInStates, KeepsInEachStateWhatIsFlatInTheOther) {
  // A thin plate, and the same with a sharp fold of its upper side in it.
  const TriangleMesh plate = isosurface(41, 0.5, [](const Vec3& p) {
    return std::min({7 - std::abs(p.x), 7 - std::abs(p.y), 1 - std::abs(p.z)});
  });
  std::vector<Vec3> folded = plate.vertices;
  const auto fold_mm = [](double x) { return 3.0 * std::max(0.0, 1.0 - std::abs(x) / 1.5); };
  for (Vec3& v : folded) {
    if (v.z > 0) v.z += fold_mm(v.x - 100);
  }
  const std::array both{plate.vertices, folded};
  constexpr std::size_t kFacets = 700;
  const auto unfaithful_mm = [&](const InStates& result) {
    double worst = 0;
    for (const Triangle& t : result.facets) {
      Vec3 middle;
      for (const std::uint32_t v : t) middle += folded[result.kept[v]] / 3.0;
      bool is_upper = true;
      for (const std::uint32_t v : t) is_upper = is_upper && plate.vertices[result.kept[v]].z > 0.9;
      if (is_upper) worst = std::max(worst, std::abs(middle.z - 1 - fold_mm(middle.x - 100)));
    }
    return worst;
  };
  const InStates blind = simplify_in_states(plate.facets, std::array{plate.vertices}, kFacets);
  const InStates seeing = simplify_in_states(plate.facets, both, kFacets);
  EXPECT_GT(unfaithful_mm(blind), 1.0);
  EXPECT_LT(unfaithful_mm(seeing), 0.5);
  EXPECT_LT(seeing.error_mm, 0.1);
  EXPECT_EQ(check_surface(mesh_of(seeing, plate.vertices)), SurfaceStatus::Ok);
}

TEST(SimplifyInStates, NeverLeavesTheManifoldsOnRuggedSurfaces) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng(seed);
    const TriangleMesh before = isosurface(7, 0.5, [&](const Vec3&) { return rng.uniform(-1, 1); });
    std::vector<Vec3> shaken = before.vertices;
    for (Vec3& v : shaken) v.z += rng.uniform(-0.5, 0.5);
    const InStates result =
        simplify_in_states(before.facets, std::array{before.vertices, shaken}, 50);
    ASSERT_EQ(check_surface(mesh_of(result, before.vertices)), SurfaceStatus::Ok) << seed;
    ASSERT_LE(result.facets.size(), before.facets.size());
  }
}

TEST(SimplifyInStates, RefusesStatesThatDoNotFit) {
  const TriangleMesh before = ball(3);
  EXPECT_THROW((void)simplify_in_states(before.facets, {}, 10), InvalidInput);
  EXPECT_THROW((void)simplify_in_states(
                   before.facets, std::array{before.vertices, std::vector<Vec3>{{1, 2, 3}}}, 10),
               InvalidInput);
}

}  // namespace
}  // namespace carpus::mesh
