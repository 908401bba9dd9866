// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Voxel grids: where voxels lie in the patient, and views on their values. The level-1 type through
// which imaging, meshing and fluoroscopy meet without knowing each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/check.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

/// Integer coordinates of a voxel; x runs fastest in memory.
struct VoxelIndex {
  int x = 0;
  int y = 0;
  int z = 0;
  constexpr bool operator==(const VoxelIndex&) const = default;
};

/// Shape and place of a voxel grid. The centre of voxel (i, j, k) lies at
/// origin + direction * (i * spacing.x, j * spacing.y, k * spacing.z) in frame Patient [mm].
struct GridGeometry {
  std::array<int, 3> size{0, 0, 0};   ///< voxels along x, y, z
  Vec3 spacing{1, 1, 1};              ///< mm between voxel centres, all > 0
  Vec3 origin{};                      ///< centre of voxel (0, 0, 0), Patient frame [mm]
  Mat3 direction = Mat3::identity();  ///< columns: grid axes in Patient; orthonormal, det +1 or -1

  constexpr bool operator==(const GridGeometry&) const = default;

  [[nodiscard]] constexpr std::size_t voxel_count() const noexcept {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  [[nodiscard]] constexpr double voxel_volume_mm3() const noexcept {
    return spacing.x * spacing.y * spacing.z;
  }
  [[nodiscard]] constexpr bool contains(const VoxelIndex& v) const noexcept {
    return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size[0] && v.y < size[1] && v.z < size[2];
  }
  /// Position in memory of a voxel inside the grid.
  [[nodiscard]] constexpr std::size_t offset_of(const VoxelIndex& v) const noexcept {
    return (static_cast<std::size_t>(v.z) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(v.y)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(v.x);
  }
  /// Inverse of offset_of.
  [[nodiscard]] constexpr VoxelIndex index_of(std::size_t offset) const noexcept {
    const auto nx = static_cast<std::size_t>(size[0]);
    const auto ny = static_cast<std::size_t>(size[1]);
    return {static_cast<int>(offset % nx), static_cast<int>((offset / nx) % ny),
            static_cast<int>(offset / (nx * ny))};
  }
  /// Patient position [mm] of continuous voxel coordinates.
  [[nodiscard]] constexpr Vec3 patient_from_voxel(const Vec3& voxel) const noexcept {
    return origin + direction * Vec3{voxel.x * spacing.x, voxel.y * spacing.y, voxel.z * spacing.z};
  }
  /// Continuous voxel coordinates of a Patient position [mm].
  [[nodiscard]] constexpr Vec3 voxel_from_patient(const Vec3& point_in_patient) const noexcept {
    const Vec3 local = direction.transposed() * (point_in_patient - origin);
    return {local.x / spacing.x, local.y / spacing.y, local.z / spacing.z};
  }
};

/// Values on a grid, owned elsewhere. T may be const.
template <typename T>
class GridView {
 public:
  GridView(const GridGeometry& geometry, std::span<T> values)
      : geometry_(geometry), values_(values) {
    CARPUS_CHECK(values.size() == geometry.voxel_count());
  }
  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] std::span<T> values() const noexcept { return values_; }
  [[nodiscard]] T& operator[](const VoxelIndex& v) const noexcept {
    return values_[geometry_.offset_of(v)];
  }
  [[nodiscard]] T& operator[](std::size_t offset) const noexcept { return values_[offset]; }
  /// A view that may write serves where one that only reads is asked for.
  operator GridView<const T>() const  // NOLINT(google-explicit-constructor)
    requires(!std::is_const_v<T>)
  {
    return {geometry_, values_};
  }

 private:
  GridGeometry geometry_;
  std::span<T> values_;
};

/// Values on a grid, owned.
template <typename T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(const GridGeometry& geometry, T fill = T{})
      : geometry_(geometry), values_(geometry.voxel_count(), fill) {}
  Grid(const GridGeometry& geometry, std::vector<T> values)
      : geometry_(geometry), values_(std::move(values)) {
    CARPUS_CHECK(values_.size() == geometry_.voxel_count());
  }

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] std::span<T> values() noexcept { return values_; }
  [[nodiscard]] std::span<const T> values() const noexcept { return values_; }
  [[nodiscard]] GridView<T> view() { return {geometry_, values_}; }
  [[nodiscard]] GridView<const T> view() const { return {geometry_, std::span<const T>(values_)}; }
  [[nodiscard]] T& operator[](const VoxelIndex& v) noexcept {
    return values_[geometry_.offset_of(v)];
  }
  [[nodiscard]] const T& operator[](const VoxelIndex& v) const noexcept {
    return values_[geometry_.offset_of(v)];
  }
  [[nodiscard]] T& operator[](std::size_t offset) noexcept { return values_[offset]; }
  [[nodiscard]] const T& operator[](std::size_t offset) const noexcept { return values_[offset]; }

 private:
  GridGeometry geometry_;
  std::vector<T> values_;
};

}  // namespace carpus
