// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/marker_ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace carpus::imaging {
namespace {

/// First and last voxel of an axis that a ball reaches, cut at the grid.
std::array<int, 2> reach(double centre, double radius_in_voxels, int size) {
  const double last = size - 1;
  return {static_cast<int>(std::clamp(std::ceil(centre - radius_in_voxels), 0.0, last)),
          static_cast<int>(std::clamp(std::floor(centre + radius_in_voxels), 0.0, last))};
}

}  // namespace

bool paint_ball(const MarkerBall& ball, const GridView<RegionLabel>& labels) {
  const GridGeometry& g = labels.geometry();
  const Vec3 at = g.voxel_from_patient(ball.centre);
  // Half a voxel beyond the outer centres still belongs to the grid. Compared before the numbers
  // are made whole, so that no far point overflows.
  const auto lies_within = [](double position, int size) {
    return position > -0.5 && position < size - 0.5;
  };
  if (!lies_within(at.x, g.size[0]) || !lies_within(at.y, g.size[1]) ||
      !lies_within(at.z, g.size[2])) {
    return false;
  }
  const VoxelIndex nearest{static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)),
                           static_cast<int>(std::lround(at.z))};
  labels[nearest] = ball.label;
  const auto [x0, x1] = reach(at.x, ball.radius_mm / g.spacing.x, g.size[0]);
  const auto [y0, y1] = reach(at.y, ball.radius_mm / g.spacing.y, g.size[1]);
  const auto [z0, z1] = reach(at.z, ball.radius_mm / g.spacing.z, g.size[2]);
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec3 off{(x - at.x) * g.spacing.x, (y - at.y) * g.spacing.y,
                       (z - at.z) * g.spacing.z};
        if (length(off) <= ball.radius_mm) labels[VoxelIndex{x, y, z}] = ball.label;
      }
    }
  }
  return true;
}

}  // namespace carpus::imaging
