// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading a grid between its voxel centres.
#pragma once

#include <cmath>

#include "geometry/grid.hpp"

namespace carpus {

/// Trilinear value at continuous voxel coordinates; `outside` where they are not within
/// [0, size - 1] on each axis (or not finite). Safe in World::step.
template <typename T>
[[nodiscard]] double sample_trilinear(const GridView<const T>& grid,
                                      const Vec3& voxel,
                                      double outside) noexcept {
  const auto& size = grid.geometry().size;
  if (!(voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x <= size[0] - 1 &&
        voxel.y <= size[1] - 1 && voxel.z <= size[2] - 1)) {
    return outside;
  }
  const VoxelIndex low{static_cast<int>(voxel.x), static_cast<int>(voxel.y),
                       static_cast<int>(voxel.z)};
  const Vec3 f{voxel.x - low.x, voxel.y - low.y, voxel.z - low.z};
  const std::size_t base = grid.geometry().offset_of(low);
  const std::size_t dx = low.x + 1 < size[0] ? 1 : 0;
  const std::size_t dy = low.y + 1 < size[1] ? static_cast<std::size_t>(size[0]) : 0;
  const std::size_t dz = low.z + 1 < size[2]
                             ? static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])
                             : 0;
  const auto value = [&](std::size_t offset) { return static_cast<double>(grid[base + offset]); };
  const auto row = [&](std::size_t offset) {
    return value(offset) * (1 - f.x) + value(offset + dx) * f.x;
  };
  const auto slice = [&](std::size_t offset) {
    return row(offset) * (1 - f.y) + row(offset + dy) * f.y;
  };
  return slice(0) * (1 - f.z) + slice(dz) * f.z;
}

/// The same at a Patient position [mm].
template <typename T>
[[nodiscard]] double sample_at(const GridView<const T>& grid,
                               const Vec3& point_in_patient,
                               double outside) noexcept {
  return sample_trilinear(grid, grid.geometry().voxel_from_patient(point_in_patient), outside);
}

}  // namespace carpus
