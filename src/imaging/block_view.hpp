// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A block of a volume, read where it lies: a copy of a large scan's part would be as large as it.
#pragma once

#include <cstddef>

#include "core/check.hpp"
#include "geometry/grid.hpp"

namespace carpus::imaging {

/// First and last voxel of a block, both inside.
struct VoxelBox {
  VoxelIndex low;
  VoxelIndex high;
};

/// The block as a grid of its own, in the same place in the patient.
[[nodiscard]] inline GridGeometry block_geometry(const GridGeometry& whole, const VoxelBox& box) {
  GridGeometry geometry = whole;
  geometry.origin =
      whole.patient_from_voxel({static_cast<double>(box.low.x), static_cast<double>(box.low.y),
                                static_cast<double>(box.low.z)});
  geometry.size = {box.high.x - box.low.x + 1, box.high.y - box.low.y + 1,
                   box.high.z - box.low.z + 1};
  return geometry;
}

/// A block of a volume that is owned elsewhere and must outlive this.
template <typename T>
class BlockView {
 public:
  BlockView(const GridView<const T>& whole, const VoxelBox& box)
      : whole_(whole), low_(box.low), geometry_(block_geometry(whole.geometry(), box)) {
    if (geometry_.voxel_count() == 0) return;
    CARPUS_CHECK(whole.geometry().contains(box.low) && whole.geometry().contains(box.high));
  }
  /// All of it.
  BlockView(const GridView<const T>& whole)  // NOLINT(google-explicit-constructor)
      : whole_(whole), geometry_(whole.geometry()) {}

  BlockView(const GridView<T>& whole)  // NOLINT(google-explicit-constructor)
      : BlockView(GridView<const T>(whole)) {}

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  /// The voxels of row y of slice z of the block, side by side.
  [[nodiscard]] const T* row(int y, int z) const noexcept {
    const VoxelIndex first{low_.x, low_.y + y, low_.z + z};
    return whole_.values().data() + whole_.geometry().offset_of(first);
  }

 private:
  GridView<const T> whole_;
  VoxelIndex low_;
  GridGeometry geometry_;
};

}  // namespace carpus::imaging
