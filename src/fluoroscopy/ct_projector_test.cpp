// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/ct_projector.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr std::int16_t kAir = -1000;

GridGeometry grid_of(int nx, int ny, int nz, Vec3 spacing) {
  GridGeometry geometry;
  geometry.size = {nx, ny, nz};
  geometry.spacing = spacing;
  return geometry;
}

/// Random lumps of tissue in air.
Grid<std::int16_t> lumps(Rng& rng, std::int16_t air = kAir) {
  Grid<std::int16_t> ct(grid_of(40, 33, 27, {0.4, 0.5, 0.7}), air);
  for (int n = 0; n < 6; ++n) {
    const Vec3 centre{rng.uniform(0, 40), rng.uniform(0, 33), rng.uniform(0, 27)};
    const double radius = rng.uniform(2, 7);
    const auto hu = static_cast<std::int16_t>(rng.uniform(-200, 1500));
    for (std::size_t i = 0; i < ct.values().size(); ++i) {
      const VoxelIndex v = ct.geometry().index_of(i);
      if (distance({double(v.x), double(v.y), double(v.z)}, centre) < radius) ct[i] = hu;
    }
  }
  return ct;
}

TEST(CtProjector, GivesAWaterCubeItsAnalyticPath) {
  // 20 x 20 x 20 mm of water from border to border; rays cross it straight and obliquely.
  const Grid<std::int16_t> ct(grid_of(41, 41, 41, {0.5, 0.5, 0.5}), 0);
  const CtProjector projector(ct.view());
  const double straight =
      static_cast<double>(projector.line_integral({-50, 20.3, 9.7}, {90, 20.3, 9.7}));
  EXPECT_NEAR(straight / kWaterPerMm, 20.5, 1e-4) << "41 planes of 0.5 mm";
  // An oblique ray through both faces of x: the same planes, each crossed along a longer way.
  const Vec3 from{-10, 10, 15};
  const Vec3 to{50, 30, 25};
  const double oblique = static_cast<double>(projector.line_integral(from, to));
  const double per_plane = 0.5 * std::sqrt(60.0 * 60 + 20 * 20 + 10 * 10) / 60;
  EXPECT_NEAR(oblique / kWaterPerMm, 41 * per_plane, 1e-4);
}

TEST(CtProjector, WeighsAnisotropicVoxelsByTheirSize) {
  const Grid<std::int16_t> ct(grid_of(20, 20, 10, {0.3, 0.4, 2.0}), 0);
  const CtProjector projector(ct.view());
  const auto path = [&](const Vec3& a, const Vec3& b) {
    return static_cast<double>(projector.line_integral(a, b)) / kWaterPerMm;
  };
  EXPECT_NEAR(path({-5, 9, 4}, {40, 9, 4}), 20 * 0.3, 1e-4);
  EXPECT_NEAR(path({9, -5, 4}, {9, 40, 4}), 20 * 0.4, 1e-4);
  EXPECT_NEAR(path({9, 9, -5}, {9, 9, 40}), 10 * 2.0, 1e-4);
}

RC_GTEST_PROP(CtProjector, AgreesWithFineSamplingOfTheTrilinearVolume, ()) {
  // Smooth densities well inside the grid, so that both sums converge to the same integral.
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  Grid<std::int16_t> filled(grid_of(60, 60, 60, {0.4, 0.5, 0.7}), kAir);
  const Vec3 a{rng.uniform(25, 35), rng.uniform(25, 35), rng.uniform(25, 35)};
  const Vec3 b{rng.uniform(25, 35), rng.uniform(25, 35), rng.uniform(25, 35)};
  for (std::size_t i = 0; i < filled.values().size(); ++i) {
    const VoxelIndex v = filled.geometry().index_of(i);
    const Vec3 p{double(v.x), double(v.y), double(v.z)};
    const double bumps =
        std::exp(-squared_length(p - a) / 50) + std::exp(-squared_length(p - b) / 32);
    filled[i] = static_cast<std::int16_t>(-1000 + 1500 * bumps);
  }
  const Grid<std::int16_t>& ct = filled;
  const CtProjector projector(ct.view());
  const Vec3 from{rng.uniform(-200, 240), rng.uniform(-200, 240), -150};
  const Vec3 through{rng.uniform(25, 35), rng.uniform(25, 35), rng.uniform(25, 35)};
  const Vec3 to = from + (through - from) * 2.5;
  const Vec3 d = to - from;
  constexpr int kSamples = 20000;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 p = from + d * ((i + 0.5) / kSamples);
    sum += attenuation_per_mm(sample_trilinear(ct.view(), p, -1000.0));
  }
  sum *= length({d.x * 0.4, d.y * 0.5, d.z * 0.7}) / kSamples;
  const auto got = static_cast<double>(projector.line_integral(from, to));
  constexpr double kRelative = 0.01;  // one reading a plane against many
  RC_ASSERT(std::abs(got - sum) < kRelative * sum + 1e-3);
}

RC_GTEST_PROP(CtProjector, SkipsAirWithoutChangingTheSum, ()) {
  // The same lumps where no block is skipped: in each, one voxel is 1 HU above the limit of air.
  // The air itself is at the limit, so that nothing else changes between voxels.
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const Grid<std::int16_t> ct = lumps(rng, static_cast<std::int16_t>(kAirHu));
  Grid<std::int16_t> nowhere_empty = ct;
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    const VoxelIndex v = ct.geometry().index_of(i);
    if (v.x % 8 == 0 && v.y % 8 == 0 && v.z % 8 == 0) {
      nowhere_empty[i] = std::max<std::int16_t>(ct[i], static_cast<std::int16_t>(kAirHu) + 1);
    }
  }
  const CtProjector skipping(ct.view());
  const CtProjector visiting(nowhere_empty.view());
  for (int ray = 0; ray < 50; ++ray) {
    const Vec3 from{rng.uniform(-60, 100), rng.uniform(-60, 100), rng.uniform(-60, -20)};
    const Vec3 to{rng.uniform(0, 39), rng.uniform(0, 32), rng.uniform(30, 80)};
    const float a = skipping.line_integral(from, to);
    const float b = visiting.line_integral(from, to);
    // At most 5 such voxels lie along a ray, each 1 HU above air.
    RC_ASSERT(a <= b + 1e-6F && b - a < 5 * 0.7 * 2 * kWaterPerMm / -kAirHu + 1e-6);
  }
}

TEST(CtProjector, MeetsNothingOutsideTheGridOrInDegenerateOnes) {
  const Grid<std::int16_t> ct(grid_of(10, 10, 10, {1, 1, 1}), 500);
  const CtProjector projector(ct.view());
  EXPECT_EQ(projector.line_integral({-5, 20, 5}, {50, 20, 5}), 0.0F);
  EXPECT_EQ(projector.line_integral({5, 5, 5}, {5, 5, 5}), 0.0F);
  EXPECT_EQ(projector.line_integral({-20, 5, 5}, {-2, 5, 5}), 0.0F) << "ends before the grid";
  const Grid<std::int16_t> one(grid_of(1, 1, 1, {1, 1, 1}), 500);
  EXPECT_EQ(CtProjector(one.view()).line_integral({0, 0, -5}, {0, 0, 5}), 0.0F);
}

TEST(Attenuation, IsNilInAirExactInWaterAndNeverFalls) {
  EXPECT_EQ(attenuation_per_mm(-1024), 0.0);
  EXPECT_DOUBLE_EQ(attenuation_per_mm(0), kWaterPerMm);
  EXPECT_NEAR(attenuation_per_mm(kCorticalHu), kCorticalPerMm, 1e-12);
  for (int hu = -1024; hu < 3000; ++hu) {
    EXPECT_LE(attenuation_per_mm(hu), attenuation_per_mm(hu + 1));
  }
}

}  // namespace
}  // namespace carpus::fluoroscopy
