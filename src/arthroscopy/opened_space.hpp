// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The joint's space as it is pulled open. It was made of the scan, where the bones lie close; under
// traction its distal wall goes with the row and its proximal one stays, and fluid fills what is
// between: the space is where either of them has it.
#pragma once

#include "fields/distance_field.hpp"
#include "geometry/grid.hpp"
#include "geometry/pose.hpp"

namespace carpus::arthroscopy {

struct OpenedSpace {
  double distance_mm = 0.0;  ///< to the wall, negative within
  Vec3 outwards;             ///< unit, frame Patient; zero where it is not known
  bool is_near = false;      ///< the grid reaches there
};

/// @param space  signed distance to the wall as scanned
/// @param forearm, row  into frame Bone of the bodies on both sides
/// Real-time: no allocation, bounded, only + - * / and sqrt.
[[nodiscard]] inline OpenedSpace opened_space_at(const Grid<float>& space,
                                                 const Pose<frame::Bone, frame::Patient>& forearm,
                                                 const Pose<frame::Bone, frame::Patient>& row,
                                                 const Vec3& at) noexcept {
  OpenedSpace best;
  for (const auto* side : {&forearm, &row}) {
    const fields::DistanceSample sample =
        fields::sample_distance(space, (*side * Point<frame::Patient>{at}).v);
    if (!sample.is_inside_grid || (best.is_near && sample.distance_mm >= best.distance_mm)) {
      continue;
    }
    const Vec3 gradient = (side->inverse() * Direction<frame::Bone>{sample.gradient}).v;
    best = {sample.distance_mm, normalized_or(gradient, {0, 0, 0}), true};
  }
  return best;
}

}  // namespace carpus::arthroscopy
