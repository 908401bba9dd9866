// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A shell of cortex about a ball, blurred by hand (analytically along the radius, nearly so in
// space), with noise: the surface must find the shell's outside.
#include "reconstruct/sharpen_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "mesh/marching_cubes.hpp"
#include "mesh/self_intersection.hpp"
#include "reconstruct/label_by_surfaces.hpp"
#include "reconstruct/surface_truth.hpp"

namespace carpus::reconstruct {
namespace {

constexpr double kSoftHu = 50;
constexpr double kCortexHu = 1200;
constexpr double kCoreHu = 300;
constexpr double kSigmaMm = 0.28;
constexpr Vec3 kCentre{0.13, -0.21, 0.08};

GridGeometry scan_grid() {
  GridGeometry g;
  g.spacing = {0.4, 0.4, 0.5};
  g.size = {60, 60, 48};
  g.origin = {-11.8, -11.8, -11.75};
  return g;
}

double below(double mm) { return 0.5 * std::erfc(-mm / (kSigmaMm * std::sqrt(2.0))); }

struct Shell {
  Vec3 centre;
  double radius;
  double thickness;
};

Grid<std::int16_t> scan_of(const std::vector<Shell>& shells, double noise_hu) {
  Grid<std::int16_t> ct(scan_grid());
  Rng rng(7);
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    const VoxelIndex v = ct.geometry().index_of(i);
    const Vec3 p = ct.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    double hu = kSoftHu;
    for (const Shell& shell : shells) {
      const double depth = shell.radius - distance(p, shell.centre);
      hu += (kCortexHu - kSoftHu) * below(depth) -
            (kCortexHu - kCoreHu) * below(depth - shell.thickness);
    }
    ct[i] = static_cast<std::int16_t>(std::lround(hu + noise_hu * rng.normal()));
  }
  return ct;
}

/// A ball whose surface has hills of `hill_mm`.
TriangleMesh ball(double radius, double hill_mm, const Vec3& centre = kCentre) {
  Grid<float> field(scan_grid());
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = field.geometry().index_of(i);
    const Vec3 p = field.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const double hill =
        hill_mm * std::sin(1.1 * p.x) * std::sin(1.3 * p.y + 1) * std::cos(0.9 * p.z);
    field[i] = static_cast<float>(radius + hill - distance(p, centre));
  }
  return mesh::extract_isosurface(field.view(), 0);
}

TEST(SharpenSurface, FindsTheEdgeOfAThickCortexUnderNoise) {
  const auto ct = scan_of({{kCentre, 8, 1.6}}, 40);
  TriangleMesh surface = ball(8.12, 0.2);
  const TriangleMesh truth = ball(8, 0);
  const double before = distance_between(surface, truth).mean_mm;
  TriangleMesh* one = &surface;
  sharpen_surfaces({&one, 1}, ct.view(), kSoftHu);
  const SurfaceDistance after = distance_between(surface, truth);
  EXPECT_GT(before, 0.1);
  EXPECT_LT(after.mean_mm, 0.4 * before);
  EXPECT_LT(after.p95_mm, 0.13);
  EXPECT_EQ(check_surface(surface), SurfaceStatus::Ok);
  EXPECT_EQ(mesh::count_self_intersections(surface), 0U);
}

TEST(SharpenSurface, OfAThinCortexAsksTheThickOneOfTheScan) {
  const Vec3 thin{-5.9, 0.1, 0.2};
  const Vec3 thick{5.8, -0.1, 0};
  const auto ct = scan_of({{thin, 4.5, 0.6}, {thick, 4.7, 1.8}}, 0);
  const TriangleMesh truth = ball(4.5, 0, thin);
  const auto off_with = [&](const SharpenOptions& options) {
    TriangleMesh a = ball(4.4, 0, thin);
    TriangleMesh b = ball(4.7, 0, thick);
    const std::vector<TriangleMesh*> both{&a, &b};
    sharpen_surfaces(both, ct.view(), kSoftHu, options);
    return distance_between(a, truth).mean_mm;
  };
  SharpenOptions half;  // of what blur left of the thin one, as if that were all its cortex
  half.thin_edge = half.thick_edge;
  EXPECT_GT(off_with(half), 0.05);
  EXPECT_LT(off_with({}), 0.6 * off_with(half));
}

TEST(SharpenSurface, MovesNothingFartherThanItMayNorWhatTheScanDoesNotShow) {
  const auto ct = scan_of({{kCentre, 8, 1.6}}, 0);
  const TriangleMesh before = ball(8.9, 0);  // 0.9 mm off: another edge may be meant
  TriangleMesh surface = before;
  TriangleMesh* one = &surface;
  sharpen_surfaces({&one, 1}, ct.view(), kSoftHu);
  EXPECT_LT(distance_between(surface, before).most_mm, 0.36);
  Grid<std::int16_t> nothing(scan_grid(), 50);
  surface = before;
  sharpen_surfaces({&one, 1}, nothing.view(), kSoftHu);
  EXPECT_EQ(surface.vertices, before.vertices);
}

TEST(LabelBySurfaces, FollowsTheSurfaceAndKeepsWhatLiesApart) {
  Grid<std::uint8_t> labels(scan_grid());
  const TriangleMesh surface = ball(6, 0);
  const std::size_t apart = labels.geometry().offset_of({1, 1, 1});
  labels[apart] = 4;
  // One layer too many, as before a surface was moved inwards.
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const VoxelIndex v = labels.geometry().index_of(i);
    const Vec3 p = labels.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    if (distance(p, kCentre) < 6.3) labels[i] = 4;
  }
  label_by_surfaces({&surface}, std::vector<std::uint8_t>{4}, labels.view());
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    if (i == apart) continue;
    const VoxelIndex v = labels.geometry().index_of(i);
    const Vec3 p = labels.geometry().patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const double off = distance(p, kCentre) - 6;
    if (std::abs(off) < 0.02) continue;
    ASSERT_EQ(labels[i], off < 0 ? 4 : 0) << off;
  }
  EXPECT_EQ(labels[apart], 4);
}

}  // namespace
}  // namespace carpus::reconstruct
