// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The rays of a picture as they ran through the scan: bent, because soft tissue has moved since.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fluoroscopy/attenuation_volume.hpp"
#include "fluoroscopy/c_arm.hpp"
#include "fluoroscopy/detail/ray_fan.hpp"
#include "fluoroscopy/tissue_bending.hpp"

namespace carpus::fluoroscopy::detail {

/// Sources in the scan of a lattice of points along rays some pixels apart, at common depths; rays
/// between them are read bilinearly. Exact where tissue moved as one. Where a ray is straight over
/// several depths, within 0.03 mm, it is one piece.
class BentFan {
 public:
  /// A point of a ray, voxel coordinates of the scan.
  struct Knot {
    float x, y, z;
    [[nodiscard]] Vec3 voxel() const noexcept { return {x, y, z}; }
  };

  BentFan(const CArmPose& pose,
          const BentTissue& tissue,
          const AttenuationVolume& scan,
          const std::vector<Pose<frame::Patient, frame::Bone>>& motions);

  /// Knots of all columns of the lattice for one row of pixels.
  void read_row(std::size_t j, std::vector<Knot>& row) const;
  /// Knots of one pixel's ray, from a row, and at which depths they lie.
  std::span<const std::uint16_t> read_ray(std::size_t i,
                                          std::size_t j,
                                          const std::vector<Knot>& row,
                                          std::vector<Knot>& ray) const;
  /// Share of the way from source to receptor between two depths.
  [[nodiscard]] double share_between(std::uint16_t from, std::uint16_t to) const noexcept {
    return step_ * (to - from);
  }

 private:
  [[nodiscard]] double share(std::size_t depth) const noexcept {
    return nearest_ + step_ * static_cast<double>(depth);
  }
  [[nodiscard]] std::size_t cell_of(std::size_t pixel) const noexcept;
  void find_bends(const Vec3& spacing);
  [[nodiscard]] std::size_t column(std::size_t c, std::size_t r) const noexcept {
    return (r * columns_ + c) * depths_;
  }

  double cell_px_;           ///< between columns and rows of the lattice
  std::size_t columns_ = 0;  ///< and as many rows
  std::size_t depths_ = 0;
  double nearest_ = 0.0;
  double step_ = 0.0;
  std::vector<Knot> nodes_;                        ///< row, column, depth (fastest)
  std::vector<std::vector<std::uint16_t>> bends_;  ///< of each cell: depths where its rays bend
};

}  // namespace carpus::fluoroscopy::detail
