// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr Direction<frame::Wrist> kLeftUlnar{{0, 1, 0}};
constexpr Direction<frame::Wrist> kRightUlnar{{0, -1, 0}};
constexpr double kVoxelMm = 0.5;

/// A cube of air of 60 mm, centred in the patient's origin.
Grid<std::int16_t> empty_scan() {
  GridGeometry geometry;
  geometry.size = {121, 121, 121};
  geometry.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  geometry.origin = {-30, -30, -30};
  return Grid<std::int16_t>(geometry, -1000);
}

/// Adds a ball, its border a voxel wide as in a real scan.
void add_ball(Grid<std::int16_t>& ct, const Vec3& centre, double radius, double hu) {
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    const VoxelIndex v = ct.geometry().index_of(i);
    const Vec3 p = ct.geometry().patient_from_voxel({double(v.x), double(v.y), double(v.z)});
    const double inside = std::clamp((radius - distance(p, centre)) / kVoxelMm + 0.5, 0.0, 1.0);
    if (inside > 0) ct[i] = static_cast<std::int16_t>(-1000 + inside * (hu + 1000));
  }
}

float value_at(const AttenuationMap& map, int i, int j) {
  return map.values[static_cast<std::size_t>(j * map.width + i)];
}

TEST(Fluoroscopy, ShowsABallWhereThePerspectivePutsIt) {
  Grid<std::int16_t> ct = empty_scan();
  const Vec3 centre{5, -7, 10};
  constexpr double kRadius = 8.0;
  add_ball(ct, centre, kRadius, 1000);
  const FluoroscopyRenderer renderer(ct.view());
  const CArmPose pose = make_c_arm_pose({0, 0}, {{0, 0, 0}}, {}, kLeftUlnar);
  const AttenuationMap map = renderer.project(pose, {});
  // The silhouette along the picture's row through the ball's projected centre line.
  const double depth = 360 + 10;  // source to the ball's centre, along the beam
  const double row_y = project_point(pose, {centre})->y;
  const int row = static_cast<int>(std::lround(row_y));
  int first = -1;
  int last = -1;
  for (int i = 0; i < map.width; ++i) {
    if (!(value_at(map, i, row) > 0.05F)) continue;
    if (first < 0) first = i;
    last = i;
  }
  // Tangents from the source: the ball's angular radius about its direction, in the row's plane.
  const double across = -centre.y;  // right in the picture is radial, -y
  const double along_row = std::sqrt(across * across + depth * depth);
  const double direction = std::atan2(across, depth);
  const double half = std::asin(kRadius / along_row);
  const auto column = [&](double angle) {
    return 255.5 + 450 * std::tan(angle) / pose.geometry.pixel_mm();
  };
  constexpr double kBorderPx = 3.0;  // half a voxel, magnified
  EXPECT_NEAR(first, column(direction - half), kBorderPx);
  EXPECT_NEAR(last, column(direction + half), kBorderPx);
  // Through the centre the path is the diameter.
  const int centre_column = static_cast<int>(std::lround(project_point(pose, {centre})->x));
  EXPECT_NEAR(static_cast<double>(value_at(map, centre_column, row)),
              2 * kRadius * attenuation_per_mm(1000),
              0.03 * 2 * kRadius * attenuation_per_mm(1000));
}

TEST(Fluoroscopy, DarkensExactlyWhereMetalProjects) {
  const Grid<std::int16_t> ct = empty_scan();
  const FluoroscopyRenderer renderer(ct.view());
  const MetalCylinder wire = make_wire({-12, 3, 5}, {14, -9, -6}, 1.14);
  for (const NamedView& view : kNamedViews) {
    const CArmPose pose = make_c_arm_pose(view.angles, {{0, 0, 0}}, {}, kLeftUlnar);
    const AttenuationMap map = renderer.project(pose, {&wire, 1});
    const PixelPosition a = *project_point(pose, {wire.start});
    const PixelPosition b = *project_point(pose, {wire.end});
    const double ab = std::hypot(b.x - a.x, b.y - a.y);
    const double half_px = 0.57 * 1.3 / pose.geometry.pixel_mm();  // its largest magnification
    for (int j = 0; j < map.height; ++j) {
      for (int i = 0; i < map.width; ++i) {
        const double along = ((i - a.x) * (b.x - a.x) + (j - a.y) * (b.y - a.y)) / ab;
        const double across = std::abs((i - a.x) * (b.y - a.y) - (j - a.y) * (b.x - a.x)) / ab;
        const bool far = across > half_px + 1 || along < -half_px - 1 || along > ab + half_px + 1;
        const bool inside = across < 0.8 * half_px && along > half_px && along < ab - half_px;
        if (far) {
          ASSERT_FALSE(value_at(map, i, j) > 0) << view.id << " at " << i << "," << j;
        }
        if (inside) {
          ASSERT_GT(value_at(map, i, j), 1.0F) << view.id << " at " << i << "," << j;
        }
      }
    }
  }
}

TEST(Fluoroscopy, GivesMirrorPicturesOfMirrorHands) {
  Grid<std::int16_t> left = empty_scan();
  add_ball(left, {5, -7, 10}, 6, 900);
  add_ball(left, {-9, 4, -3}, 4, 200);
  Grid<std::int16_t> right = left;
  for (std::size_t i = 0; i < right.values().size(); ++i) {
    const VoxelIndex v = right.geometry().index_of(i);
    right[i] = left[VoxelIndex{v.x, 120 - v.y, v.z}];
  }
  const ViewAngles view{45, 10};
  const AttenuationMap a = FluoroscopyRenderer(left.view())
                               .project(make_c_arm_pose(view, {{0, 0, 0}}, {}, kLeftUlnar), {});
  const AttenuationMap b = FluoroscopyRenderer(right.view())
                               .project(make_c_arm_pose(view, {{0, 0, 0}}, {}, kRightUlnar), {});
  for (int j = 0; j < a.height; j += 3) {
    for (int i = 0; i < a.width; i += 3) {
      const float p = value_at(a, i, j);
      const float q = value_at(b, a.width - 1 - i, j);
      if (std::isnan(p)) {
        ASSERT_TRUE(std::isnan(q));
      } else {
        ASSERT_NEAR(p, q, 2e-4F) << i << "," << j;
      }
    }
  }
}

TEST(Fluoroscopy, ClosesTheCollimatorWhereTheScanCutsTheLimb) {
  Grid<std::int16_t> ct = empty_scan();
  for (std::size_t i = 0; i < ct.values().size(); ++i) {
    const VoxelIndex v = ct.geometry().index_of(i);
    if (std::hypot(v.y - 60, v.z - 60) < 30) ct[i] = 40;  // a forearm along x
  }
  const CArmPose pose = make_c_arm_pose({0, 0}, {{0, 0, 0}}, {}, kLeftUlnar);
  const AttenuationMap map = FluoroscopyRenderer(ct.view()).project(pose, {});
  const auto covered = [&](double x, double y) {
    const PixelPosition p = *project_point(pose, {{x, y, 0}});
    return std::isnan(value_at(map, static_cast<int>(p.x), static_cast<int>(p.y)));
  };
  EXPECT_TRUE(covered(29, 0) && covered(-29, 0)) << "the limb's ends";
  EXPECT_FALSE(covered(26, 0) || covered(-26, 0));
  EXPECT_FALSE(covered(0, 35) || covered(0, -35)) << "air beside the limb is no end";
}

TEST(Fluoroscopy, RepeatsItselfByteByByteForASeedAndHoweverRowsAreShared) {
  Grid<std::int16_t> ct = empty_scan();
  add_ball(ct, {0, 0, 0}, 10, 300);
  const FluoroscopyRenderer renderer(ct.view());
  const CArmPose pose = make_c_arm_pose({20, 5}, {{0, 0, 0}}, {}, kLeftUlnar);
  Exposure exposure;
  const Image once = renderer.render(pose, {}, exposure);
  install_parallel_executor([](std::size_t count, std::size_t, const auto& body) {
    for (std::size_t i = count; i-- > 0;) body(i, i + 1);  // one row at a time, backwards
  });
  const Image again = renderer.render(pose, {}, exposure);
  install_parallel_executor({});
  EXPECT_EQ(once.grey, again.grey);
  exposure.seed = 2;
  EXPECT_NE(once.grey, renderer.render(pose, {}, exposure).grey);
}

}  // namespace
}  // namespace carpus::fluoroscopy
