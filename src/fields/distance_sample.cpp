// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The 1 kHz side of the distance field.
#include <cstddef>

#include "fields/distance_field.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::fields {

DistanceSample sample_distance(const Grid<float>& field, const Vec3& point) noexcept {
  const GridGeometry& grid = field.geometry();
  Vec3 voxel = grid.voxel_from_patient(point);
  DistanceSample result;
  result.is_inside_grid = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int last = grid.size[axis] - 1;
    const bool is_within = voxel[axis] >= 0 && voxel[axis] <= last;  // false for NaN
    result.is_inside_grid = result.is_inside_grid && is_within;
    if (!is_within) voxel[axis] = voxel[axis] > 0 ? last : 0.0;
  }
  const TrilinearCell cell(field, voxel);
  result.distance_mm = cell.value();
  if (!result.is_inside_grid) return result;
  const Vec3 by_voxel = cell.slope();
  result.gradient = grid.direction * Vec3{by_voxel.x / grid.spacing.x, by_voxel.y / grid.spacing.y,
                                          by_voxel.z / grid.spacing.z};
  return result;
}

}  // namespace carpus::fields
