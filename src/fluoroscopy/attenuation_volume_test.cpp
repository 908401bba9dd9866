// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/attenuation_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "fluoroscopy/ct_projector.hpp"

namespace carpus::fluoroscopy {
namespace {

Grid<std::int16_t> grid_of(int x, int y, int z) {
  GridGeometry g;
  g.size = {x, y, z};
  return Grid<std::int16_t>(g);
}

/// A blob in a corner of a grid that is mostly empty.
Grid<std::int16_t> blob() {
  Grid<std::int16_t> grid = grid_of(40, 33, 50);
  Rng rng(5);
  for (std::size_t i = 0; i < grid.values().size(); ++i) {
    const VoxelIndex v = grid.geometry().index_of(i);
    const double d = length({v.x - 9.0, v.y - 20.0, v.z - 30.0});
    if (d < 8) grid[i] = static_cast<std::int16_t>(rng.below(3000));
  }
  return grid;
}

Vec3 any_point(Rng& rng) {
  return {rng.uniform(-10, 50), rng.uniform(-10, 43), rng.uniform(-10, 60)};
}

TEST(AttenuationVolume, GivesAWholeLineAsTheSumOfItsPieces) {
  const Grid<std::int16_t> grid = blob();
  const AttenuationVolume volume(grid.view());
  Rng rng(1);
  int met = 0;
  for (int line = 0; line < 500; ++line) {
    const Vec3 from = any_point(rng);
    const Vec3 to = any_point(rng);
    const auto whole = static_cast<double>(volume.mean_between(from, to)) * distance(from, to);
    double sum = 0;
    Vec3 a = from;
    for (int piece = 1; piece <= 7; ++piece) {
      const Vec3 b = from + (to - from) * (piece / 7.0);
      sum += static_cast<double>(volume.mean_between(a, b)) * distance(a, b);
      a = b;
    }
    met += whole > 0 ? 1 : 0;
    ASSERT_NEAR(sum, whole, 1e-4 * (1 + whole)) << line;
  }
  EXPECT_GT(met, 50);
}

TEST(AttenuationVolume, ReadsAnEvenBlockAsItsPathWherePiecesEndAnywhere) {
  Grid<std::int16_t> grid = grid_of(20, 20, 20);
  for (std::int16_t& value : grid.values()) value = 1000;
  const AttenuationVolume volume(grid.view());
  Rng rng(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 a{rng.uniform(0, 19), rng.uniform(0, 19), rng.uniform(0, 19)};
    const Vec3 b{rng.uniform(0, 19), rng.uniform(0, 19), rng.uniform(0, 19)};
    const bool is_inside = [&] {  // planes reach half a voxel beyond a piece's ends
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::min(a[k], b[k]) < 0.5 || std::max(a[k], b[k]) > 18.5) return false;
      }
      return true;
    }();
    if (!is_inside) continue;
    ASSERT_NEAR(static_cast<double>(volume.mean_between(a, b)), 0.01, 1e-7);
  }
  EXPECT_NEAR(static_cast<double>(volume.mean_between({-10, 9.3, 9.6}, {30, 9.3, 9.6})) * 40,
              0.01 * 19, 1e-6)
      << "from centre to centre of the outermost voxels";
}

TEST(AttenuationVolume, SkipsNothingThatARayMeets) {
  const Grid<std::int16_t> grid = blob();
  const AttenuationVolume volume(grid.view());
  Grid<std::int16_t> with_floor = grid;  // 1 everywhere: no block can be skipped
  for (std::int16_t& value : with_floor.values()) value = static_cast<std::int16_t>(value + 1);
  const AttenuationVolume all(with_floor.view());
  Grid<std::int16_t> floor = grid_of(40, 33, 50);
  for (std::int16_t& value : floor.values()) value = 1;
  const AttenuationVolume one(floor.view());
  Rng rng(3);
  for (int line = 0; line < 2000; ++line) {
    const Vec3 a = any_point(rng);
    const Vec3 b = any_point(rng);
    ASSERT_NEAR(volume.mean_between(a, b), all.mean_between(a, b) - one.mean_between(a, b), 1e-8)
        << line;
  }
}

TEST(AttenuationVolume, AgreesWithTheProjectorOfHuWhereAttenuationIsLinear) {
  Grid<std::int16_t> ct = grid_of(30, 30, 30);
  Grid<std::int16_t> units = ct;
  Rng rng(4);
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    ct[i] = static_cast<std::int16_t>(rng.below(1500));
    units[i] = attenuation_units(ct[i]);
  }
  const CtProjector projector(ct.view());
  const AttenuationVolume volume(units.view());
  for (int line = 0; line < 200; ++line) {
    const Vec3 a{rng.uniform(0, 29), rng.uniform(0, 29), -5};
    const Vec3 b{rng.uniform(0, 29), rng.uniform(0, 29), 35};
    const double expected = projector.line_integral(a, b);
    // Of a ray that leaves by a side the projector counts whole planes.
    ASSERT_NEAR(volume.mean_between(a, b) * distance(a, b), expected, 0.2) << line;
  }
  const Vec3 a{12.3, 14.1, -5};
  const Vec3 b{17.2, 11.7, 35};
  // From face to face the outer planes count half: what lies beyond them is outside.
  EXPECT_NEAR(volume.mean_between(a, b) * distance(a, b), projector.line_integral(a, b), 0.13);
}

TEST(AttenuationVolume, MeetsNothingOutsideInAPointOrInAnEmptyGrid) {
  Grid<std::int16_t> grid = grid_of(10, 10, 10);
  for (std::int16_t& value : grid.values()) value = 1000;
  const AttenuationVolume volume(grid.view());
  EXPECT_EQ(volume.mean_between({-5, 20, 5}, {50, 20, 5}), 0.0F);
  EXPECT_EQ(volume.mean_between({5, 5, 5}, {5, 5, 5}), 0.0F);
  EXPECT_EQ(volume.mean_between({-20, 5, 5}, {-2, 5, 5}), 0.0F);
  EXPECT_EQ(AttenuationVolume().mean_between({-1, -1, -1}, {1, 1, 1}), 0.0F);
  const AttenuationVolume empty(grid_of(10, 10, 10).view());
  EXPECT_TRUE(empty.occupied().is_empty());
  EXPECT_EQ(volume.occupied(), whole_of(grid.geometry()));
}

}  // namespace
}  // namespace carpus::fluoroscopy
