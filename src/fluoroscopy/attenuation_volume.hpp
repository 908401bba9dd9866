// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Attenuation on a grid, to be summed along straight pieces of rays. Unlike a CT in HU it adds up:
// volumes whose voxels sum to a third one's also project to that one's picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fluoroscopy/removed_bone.hpp"
#include "geometry/grid.hpp"

namespace carpus::fluoroscopy {

/// Attenuation is stored in units of this [1/mm]: water is 2683, and what exceeds 4690 HU counts as
/// that.
inline constexpr double kAttenuationUnitPerMm = 1e-5;

/// The attenuation of a voxel of so many HU, rounded to units.
[[nodiscard]] std::int16_t attenuation_units(std::int16_t hu) noexcept;

/// Owned; safe to read from many threads. Nothing attenuates outside the outermost voxel centres.
class AttenuationVolume {
 public:
  AttenuationVolume() = default;
  /// @param units  kAttenuationUnitPerMm, may be negative; copied.
  explicit AttenuationVolume(const GridView<const std::int16_t>& units);

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] std::int16_t units_at(const VoxelIndex& v) const noexcept {
    return values_[offset_of(v)];
  }
  /// Changes a voxel that was not 0 when the volume was made: others may lie in blocks that rays
  /// skip. Not while another thread reads.
  void set_units(const VoxelIndex& v, std::int16_t units) noexcept {
    values_[offset_of(v)] = units;
  }

  /// Mean attenuation [1/mm] between two points in continuous voxel coordinates, by Joseph's
  /// method: one bilinear reading for each voxel plane crossed along the steeper axis, the outer
  /// ones by the share of their voxel that is crossed. Pieces of one straight line add up to the
  /// whole line; 0 for a point.
  [[nodiscard]] float mean_between(const Vec3& from_voxel, const Vec3& to_voxel) const noexcept;

  /// Trilinear attenuation [1/mm] at a position in the grid's frame [mm]; slow.
  [[nodiscard]] double value_at(const Vec3& point_mm) const noexcept;

  /// Voxels that hold anything, with the voxels around them that a ray may read them from.
  [[nodiscard]] const IndexBox& occupied() const noexcept { return occupied_box_; }

 private:
  static constexpr int kBlock = 8;
  static constexpr int kPad = 2;  ///< voxels of nothing around the grid, instead of range checks

  [[nodiscard]] std::size_t offset_of(const VoxelIndex& v) const noexcept {
    return static_cast<std::size_t>(v.x + kPad) * static_cast<std::size_t>(strides_[0]) +
           static_cast<std::size_t>(v.y + kPad) * static_cast<std::size_t>(strides_[1]) +
           static_cast<std::size_t>(v.z + kPad) * static_cast<std::size_t>(strides_[2]);
  }
  void mark_blocks();
  void spread_blocks(std::size_t axis);

  GridGeometry geometry_;
  std::array<std::ptrdiff_t, 3> strides_{};
  std::vector<std::int16_t> values_;
  std::array<int, 3> blocks_{};
  std::vector<std::uint8_t> occupied_;  ///< per block: it or a neighbour holds something
  IndexBox occupied_box_;
};

}  // namespace carpus::fluoroscopy
