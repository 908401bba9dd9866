// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/moving_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluoroscopy/bone_phantom_test_support.hpp"

namespace carpus::fluoroscopy {
namespace {

/// A ball of bone of 6 mm in air, voxels of 0.5 mm.
MovingBody ball_of_bone() {
  const test::Phantom p =
      test::make_phantom(41, 0.5, {test::ball({0, 0, 0}, 6)}, 1000, test::ball({0, 0, 0}, -1), 0);
  const std::array<std::uint8_t, 1> label{1};
  return MovingBody(std::move(split_tissue(p.ct.view(), p.labels.view(), label).bodies[0]));
}

double total(const MovingBody& body) {
  const AttenuationVolume& v = body.volume();
  double sum = 0;
  for (std::size_t i = 0; i < v.geometry().voxel_count(); ++i) {
    sum += v.units_at(v.geometry().index_of(i));
  }
  return sum * v.geometry().voxel_volume_mm3() * kAttenuationUnitPerMm;
}

/// A canal of 2 mm along x through the middle, in voxels of so many mm.
Grid<std::uint8_t> canal(double voxel_mm) {
  GridGeometry g;
  const int side = static_cast<int>(16 / voxel_mm) + 1;
  g.size = {side, side, side};
  g.spacing = {voxel_mm, voxel_mm, voxel_mm};
  g.origin = {-0.5 * (side - 1) * voxel_mm, -0.5 * (side - 1) * voxel_mm,
              -0.5 * (side - 1) * voxel_mm};
  Grid<std::uint8_t> share(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const double inside = std::clamp(0.5 + (1.0 - std::hypot(p.y, p.z)) / voxel_mm, 0.0, 1.0);
    share[i] = static_cast<std::uint8_t>(std::lround(255 * inside));
  }
  return share;
}

RemovedBone removed_of(const Grid<std::uint8_t>& share) {
  return {share.geometry(), share.values()};
}

TEST(MovingBody, LosesTheMassOfTheCanalThatWasDrilledWhateverTheGrid) {
  const double bone = static_cast<double>(attenuation_units(1000)) * kAttenuationUnitPerMm;
  for (const double voxel_mm : {0.15, 0.5, 0.8}) {
    MovingBody body = ball_of_bone();
    const double before = total(body);
    const Grid<std::uint8_t> share = canal(voxel_mm);
    body.set_removed(removed_of(share), whole_of(share.geometry()));
    double gone_mm3 = 0;  // of the ball
    for (std::size_t i = 0; i < share.values().size(); ++i) {
      const VoxelIndex v = share.geometry().index_of(i);
      const Vec3 p = share.geometry().patient_from_voxel(
          {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
      if (length(p) < 6) gone_mm3 += share[i] / 255.0 * share.geometry().voxel_volume_mm3();
    }
    EXPECT_NEAR(before - total(body), bone * gone_mm3, 0.05 * bone * gone_mm3) << voxel_mm;
    EXPECT_EQ(body.revision(), 1U);
    body.restore();
    EXPECT_EQ(total(body), before);
  }
}

TEST(MovingBody, IsTheSameWhetherToldAtOnceOrBrickByBrick) {
  const Grid<std::uint8_t> share = canal(0.3);
  MovingBody at_once = ball_of_bone();
  at_once.set_removed(removed_of(share), whole_of(share.geometry()));
  MovingBody in_bricks = ball_of_bone();
  Grid<std::uint8_t> known(share.geometry());
  constexpr int kBrick = 8;
  const auto& size = share.geometry().size;
  for (int z = 0; z < size[2]; z += kBrick) {
    for (int y = 0; y < size[1]; y += kBrick) {
      for (int x = 0; x < size[0]; x += kBrick) {
        const IndexBox brick{{x, y, z}, {x + kBrick, y + kBrick, z + kBrick}};
        for (std::size_t i = 0; i < known.values().size(); ++i) {
          const VoxelIndex v = known.geometry().index_of(i);
          const bool is_inside = v.x >= x && v.x < x + kBrick && v.y >= y && v.y < y + kBrick &&
                                 v.z >= z && v.z < z + kBrick;
          if (is_inside) known[i] = share[i];
        }
        in_bricks.set_removed(removed_of(known), brick);
      }
    }
  }
  const GridGeometry& g = at_once.volume().geometry();
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    ASSERT_EQ(in_bricks.volume().units_at(g.index_of(i)), at_once.volume().units_at(g.index_of(i)));
  }
}

TEST(MovingBody, IgnoresBoxesBesideTheBodyOrBeyondTheGrid) {
  MovingBody body = ball_of_bone();
  const double before = total(body);
  const Grid<std::uint8_t> share = canal(0.5);
  body.set_removed(removed_of(share), {{5, 5, 5}, {5, 9, 9}});
  body.set_removed(removed_of(share), {{100, 0, 0}, {200, 9, 9}});
  EXPECT_EQ(total(body), before);
  EXPECT_EQ(body.revision(), 0U);
}

}  // namespace
}  // namespace carpus::fluoroscopy
