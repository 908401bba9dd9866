// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading a grid between its voxel centres. Safe in World::step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "geometry/grid.hpp"

namespace carpus {

/// The eight values about a place and how it lies among them: the one trilinear interpolation.
class TrilinearCell {
 public:
  /// @param grid  a Grid or a GridView.
  /// @param voxel  continuous voxel coordinates within [0, size - 1] on each axis.
  template <typename AnyGrid>
  TrilinearCell(const AnyGrid& grid, const Vec3& voxel) noexcept {
    const auto& size = grid.geometry().size;
    const auto nx = static_cast<std::size_t>(size[0]);
    const std::array<std::size_t, 3> strides{1, nx, nx * static_cast<std::size_t>(size[1])};
    std::array<std::size_t, 3> step{};  // 0 along an axis of one voxel
    std::size_t base = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int low = std::min(static_cast<int>(voxel[axis]), std::max(0, size[axis] - 2));
      base += static_cast<std::size_t>(low) * strides[axis];
      step[axis] = size[axis] > 1 ? strides[axis] : 0;
      f_[axis] = voxel[axis] - low;
    }
    const auto read = [&](std::size_t offset) { return static_cast<double>(grid[offset]); };
    const std::size_t far_y = base + step[1];
    const std::size_t far_z = base + step[2];
    const std::size_t far_yz = far_y + step[2];
    corners_ = {read(base),  read(base + step[0]),  read(far_y),  read(far_y + step[0]),
                read(far_z), read(far_z + step[0]), read(far_yz), read(far_yz + step[0])};
  }

  [[nodiscard]] double value() const noexcept { return mix(slice(0), slice(4), f_.z); }
  /// Change of the value by voxel along each axis.
  [[nodiscard]] Vec3 slope() const noexcept {
    const auto along_x = [&](std::size_t i) { return corners_[i + 1] - corners_[i]; };
    return {mix(mix(along_x(0), along_x(2), f_.y), mix(along_x(4), along_x(6), f_.y), f_.z),
            mix(row(2) - row(0), row(6) - row(4), f_.z), slice(4) - slice(0)};
  }

 private:
  static double mix(double a, double b, double t) noexcept { return a * (1 - t) + b * t; }
  [[nodiscard]] double row(std::size_t i) const noexcept {
    return mix(corners_[i], corners_[i + 1], f_.x);
  }
  [[nodiscard]] double slice(std::size_t i) const noexcept { return mix(row(i), row(i + 2), f_.y); }

  std::array<double, 8> corners_{};  ///< x changes fastest, then y
  Vec3 f_;                           ///< 0 to 1 from corner 0
};

/// Trilinear value at continuous voxel coordinates; `outside` where they are not within
/// [0, size - 1] on each axis (or not finite).
template <typename T>
[[nodiscard]] double sample_trilinear(const GridView<const T>& grid,
                                      const Vec3& voxel,
                                      double outside) noexcept {
  const auto& size = grid.geometry().size;
  if (!(voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x <= size[0] - 1 &&
        voxel.y <= size[1] - 1 && voxel.z <= size[2] - 1)) {
    return outside;
  }
  return TrilinearCell(grid, voxel).value();
}

/// The same at a Patient position [mm].
template <typename T>
[[nodiscard]] double sample_at(const GridView<const T>& grid,
                               const Vec3& point_in_patient,
                               double outside) noexcept {
  return sample_trilinear(grid, grid.geometry().voxel_from_patient(point_in_patient), outside);
}

/// The value of the voxel of a Grid or GridView that holds a Patient position [mm]; `outside`
/// beyond the grid.
template <typename AnyGrid, typename T>
[[nodiscard]] T voxel_at(const AnyGrid& grid, const Vec3& point_in_patient, T outside) noexcept {
  const Vec3 v = grid.geometry().voxel_from_patient(point_in_patient) + Vec3{0.5, 0.5, 0.5};
  const auto& size = grid.geometry().size;
  if (!(v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size[0] && v.y < size[1] && v.z < size[2])) {
    return outside;
  }
  return grid[VoxelIndex{static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)}];
}

}  // namespace carpus
