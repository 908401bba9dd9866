// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Markers as a person places them: a point, or a ball about it.
#pragma once

#include "geometry/grid.hpp"
#include "geometry/vec3.hpp"
#include "imaging/watershed.hpp"

namespace carpus::imaging {

struct MarkerBall {
  RegionLabel label = 0;
  Vec3 centre;           ///< Patient [mm]
  double radius_mm = 0;  ///< 0: the voxel at the centre alone
};

/// Gives `ball.label` to the voxel nearest to the ball's centre and to every voxel whose centre
/// lies in the ball; what lies beyond the grid is left out. Returns false, and changes nothing,
/// where the ball's centre is not in the grid.
[[nodiscard]] bool paint_ball(const MarkerBall& ball, const GridView<RegionLabel>& labels);

}  // namespace carpus::imaging
