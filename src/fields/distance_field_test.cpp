// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::fields {
namespace {

/// A closed surface of revolution about z with a waist, not convex, like a bone; `n` steps around.
TriangleMesh waisted_body(int n, const Vec3& centre) {
  TriangleMesh mesh;
  const int rings = n / 2;
  mesh.vertices.push_back(centre + Vec3{0, 0, -8});
  for (int r = 1; r < rings; ++r) {
    const double z = -8.0 + 16.0 * r / rings;
    const double radius = std::sqrt(64.0 - z * z) * (0.45 + 0.35 * (z / 8) * (z / 8));
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n;
      mesh.vertices.push_back(centre + Vec3{radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  mesh.vertices.push_back(centre + Vec3{0, 0, 8});
  const auto at = [&](int ring, int i) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * n + (i + n) % n);
  };
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int i = 0; i < n; ++i) {
    mesh.facets.push_back({0, at(1, i + 1), at(1, i)});
    mesh.facets.push_back({top, at(rings - 1, i), at(rings - 1, i + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.facets.push_back({at(r, i), at(r, i + 1), at(r + 1, i + 1)});
      mesh.facets.push_back({at(r, i), at(r + 1, i + 1), at(r + 1, i)});
    }
  }
  return mesh;
}

/// Distance by all triangles, sign by the solid angle (winding number) of all triangles.
double brute_force_distance(const TriangleMesh& mesh, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  double solid_angle = 0;
  for (const Triangle& t : mesh.facets) {
    const Vec3 a = mesh.vertices[t[0]] - p;
    const Vec3 b = mesh.vertices[t[1]] - p;
    const Vec3 c = mesh.vertices[t[2]] - p;
    best = std::min(best, length(nearest_point_on_triangle({}, a, b, c)));
    const double la = length(a);
    const double lb = length(b);
    const double lc = length(c);
    solid_angle += 2 * std::atan2(dot(a, cross(b, c)),
                                  la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return solid_angle > 6 ? -best : best;
}

TEST(TriangleTree, FindsTheNearestPointThatAScanFinds) {
  const TriangleMesh mesh = waisted_body(24, {1, 2, 3});
  const TriangleTree tree(mesh);
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{rng.uniform(-12, 14), rng.uniform(-12, 14), rng.uniform(-10, 16)};
    const double expected = std::abs(brute_force_distance(mesh, p));
    const auto hint = static_cast<std::uint32_t>(rng.below(mesh.facets.size()));
    const NearestPoint found = tree.nearest(p, 1e9, hint).value_or(NearestPoint{});
    ASSERT_NEAR(std::sqrt(found.squared_distance), expected, 1e-12);
    ASSERT_NEAR(distance(found.point, p), expected, 1e-12);
    ASSERT_EQ(tree.nearest(p, 2.0).has_value(), expected < 2.0);
  }
  EXPECT_FALSE(TriangleTree(TriangleMesh{}).nearest({0, 0, 0}));
}

TEST(TriangleTree, MeasuresToATriangleByAllItsRegions) {
  const Vec3 a{0, 0, 0};
  const Vec3 b{4, 0, 0};
  const Vec3 c{0, 3, 0};
  Rng rng(2);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p{rng.uniform(-3, 7), rng.uniform(-3, 6), rng.uniform(-2, 2)};
    double best = 1e9;
    for (int u = 0; u <= 300; ++u) {
      for (int v = 0; u + v <= 300; ++v) {
        best = std::min(best, distance(p, a + (b - a) * (u / 300.0) + (c - a) * (v / 300.0)));
      }
    }
    const double found = distance(p, nearest_point_on_triangle(p, a, b, c));
    ASSERT_LE(found, best + 1e-12);
    ASSERT_NEAR(found, best, 0.02);
  }
  EXPECT_EQ(nearest_point_on_triangle({1, 1, 1}, a, a, a), a);
}

TEST(DistanceField, IsExactAtVoxelsAndClampedOutsideTheBand) {
  const TriangleMesh mesh = waisted_body(24, {5, -3, 40});
  const Grid<float> field = build_distance_field(mesh, {.spacing_mm = 0.9, .band_mm = 2.5});
  std::size_t inside = 0;
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = field.geometry().index_of(i);
    const Vec3 p = field.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const double expected = std::clamp(brute_force_distance(mesh, p), -2.5, 2.5);
    ASSERT_NEAR(static_cast<double>(field[i]), expected, 1e-6);
    inside += field[i] < 0;
  }
  EXPECT_NEAR(static_cast<double>(inside) * field.geometry().voxel_volume_mm3() / volume_of(mesh),
              1, 0.05);
}

TEST(DistanceField, SamplesBetweenVoxelsWithinAKnownError) {
  const TriangleMesh mesh = waisted_body(40, {5, -3, 40});
  const Grid<float> field = build_distance_field(mesh);
  Rng rng(3);
  double worst = 0;
  double worst_near = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{5 + rng.uniform(-9, 9), -3 + rng.uniform(-9, 9), 40 + rng.uniform(-10, 10)};
    const double expected = brute_force_distance(mesh, p);
    if (std::abs(expected) > 3.5) continue;
    const DistanceSample sample = sample_distance(field, p);
    ASSERT_TRUE(sample.is_inside_grid);
    const double error = std::abs(sample.distance_mm - expected);
    worst = std::max(worst, error);
    if (std::abs(expected) < 0.4) worst_near = std::max(worst_near, error);
  }
  EXPECT_LT(worst, 0.25);       // kinks of the distance (the medial axis) cost up to half a voxel
  EXPECT_LT(worst_near, 0.08);  // at the surface, where contact is decided
}

TEST(DistanceField, HasAGradientThatMatchesItsOwnDifferences) {
  const Grid<float> field = build_distance_field(waisted_body(30, {0, 0, 0}));
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(-10, 10)};
    const Vec3 voxel = field.geometry().voxel_from_patient(p);
    bool is_within_cell = true;  // the interpolation has a kink at voxel planes
    for (std::size_t a = 0; a < 3; ++a) {
      const double f = voxel[a] - std::floor(voxel[a]);
      is_within_cell = is_within_cell && f > 0.01 && f < 0.99;
    }
    if (!is_within_cell) continue;
    const DistanceSample sample = sample_distance(field, p);
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 h{};
      h[a] = 1e-3;
      const double slope =
          (sample_distance(field, p + h).distance_mm - sample_distance(field, p - h).distance_mm) /
          2e-3;
      ASSERT_NEAR(sample.gradient[a], slope, 1e-6);
    }
    for (std::size_t a = 0; a < 3; ++a) {  // a distance changes by no more than the way
      ASSERT_LE(std::abs(sample.gradient[a]), 1 + 1e-5);
    }
  }
}

TEST(DistanceField, AnswersOutsideItsGridAndForNaN) {
  const Grid<float> field = build_distance_field(waisted_body(12, {0, 0, 0}));
  const DistanceSample far = sample_distance(field, {100, 0, 0});
  EXPECT_FALSE(far.is_inside_grid);
  EXPECT_NEAR(far.distance_mm, 4, 0.5);
  EXPECT_EQ(far.gradient, Vec3{});
  const DistanceSample nan =
      sample_distance(field, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_FALSE(nan.is_inside_grid);
  EXPECT_TRUE(std::isfinite(nan.distance_mm));
}

TEST(DistanceField, SignsRowsThatPassThroughVerticesAndEdges) {
  // A box whose corners, edges and faces lie on voxel centres.
  TriangleMesh box;
  for (int i = 0; i < 8; ++i) {
    box.vertices.push_back({4.0 * (i & 1), 4.0 * (i >> 1 & 1), 4.0 * (i >> 2 & 1)});
  }
  box.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  ASSERT_EQ(check_surface(box), SurfaceStatus::Ok);
  const Grid<float> field = build_distance_field(box, {.spacing_mm = 0.5, .band_mm = 2});
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = field.geometry().index_of(i);
    const Vec3 p = field.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const double outside = std::max({-p.x, p.x - 4, -p.y, p.y - 4, -p.z, p.z - 4});
    if (outside != 0) {
      ASSERT_EQ(field[i] < 0, outside < 0) << p.x << " " << p.y << " " << p.z;
    }
  }
}

TEST(DistanceField, RefusesOpenSurfacesAndImpossibleSpacings) {
  TriangleMesh open = waisted_body(12, {0, 0, 0});
  open.facets.pop_back();
  EXPECT_THROW((void)build_distance_field(open), InvalidInput);
  const TriangleMesh body = waisted_body(12, {0, 0, 0});
  EXPECT_THROW((void)build_distance_field(body, {.spacing_mm = 0}), InvalidInput);
  EXPECT_THROW((void)build_distance_field(body, {.spacing_mm = 1e-4}), InvalidInput);
}

}  // namespace
}  // namespace carpus::fields
