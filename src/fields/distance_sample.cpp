// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The 1 kHz side of the distance field.
#include <algorithm>
#include <array>
#include <cstddef>

#include "fields/distance_field.hpp"

namespace carpus::fields {

DistanceSample sample_distance(const Grid<float>& field, const Vec3& point) noexcept {
  const GridGeometry& grid = field.geometry();
  const Vec3 voxel = grid.voxel_from_patient(point);
  DistanceSample result;
  result.is_inside_grid = true;
  std::array<int, 3> low{};
  std::array<int, 3> step{};  // 0 along an axis of one voxel
  Vec3 f;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int last = grid.size[axis] - 1;
    const bool is_within = voxel[axis] >= 0 && voxel[axis] <= last;  // false for NaN
    result.is_inside_grid = result.is_inside_grid && is_within;
    const double x = is_within ? voxel[axis] : (voxel[axis] > 0 ? last : 0.0);
    low[axis] = std::min(static_cast<int>(x), std::max(0, last - 1));
    step[axis] = last > 0 ? 1 : 0;
    f[axis] = x - low[axis];
  }
  const auto value = [&](int dx, int dy, int dz) {
    return static_cast<double>(
        field[VoxelIndex{low[0] + dx * step[0], low[1] + dy * step[1], low[2] + dz * step[2]}]);
  };
  const auto mix = [](double a, double b, double t) { return a * (1 - t) + b * t; };
  const double v000 = value(0, 0, 0);
  const double v100 = value(1, 0, 0);
  const double v010 = value(0, 1, 0);
  const double v110 = value(1, 1, 0);
  const double v001 = value(0, 0, 1);
  const double v101 = value(1, 0, 1);
  const double v011 = value(0, 1, 1);
  const double v111 = value(1, 1, 1);
  const double v00 = mix(v000, v100, f.x);
  const double v10 = mix(v010, v110, f.x);
  const double v01 = mix(v001, v101, f.x);
  const double v11 = mix(v011, v111, f.x);
  const double v0 = mix(v00, v10, f.y);
  const double v1 = mix(v01, v11, f.y);
  result.distance_mm = mix(v0, v1, f.z);
  if (!result.is_inside_grid) return result;
  const Vec3 slope{
      mix(mix(v100 - v000, v110 - v010, f.y), mix(v101 - v001, v111 - v011, f.y), f.z) /
          grid.spacing.x,
      mix(v10 - v00, v11 - v01, f.z) / grid.spacing.y, (v1 - v0) / grid.spacing.z};
  result.gradient = grid.direction * slope;
  return result;
}

}  // namespace carpus::fields
