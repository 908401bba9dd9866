// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a scan ends across a limb, beyond which nothing is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::fluoroscopy {

/// One face of the scan that cuts through tissue.
struct ScanCut {
  std::size_t axis = 0;
  bool is_high_end = false;
  double leaf_voxel = 0.0;  ///< along the axis: where the collimator's leaf closes, a little inside
  Vec3 centre_mm;           ///< of the tissue on the face, in the grid's frame

  /// Whether the leaf covers a point, in voxel coordinates.
  [[nodiscard]] bool covers(const Vec3& voxel) const noexcept {
    return is_high_end ? voxel[axis] > leaf_voxel : voxel[axis] < leaf_voxel;
  }
};

/// The faces of which more than 2 % are tissue.
/// @param ct  HU.
[[nodiscard]] std::vector<ScanCut> find_scan_cuts(const GridView<const std::int16_t>& ct);

[[nodiscard]] inline bool is_covered(const std::vector<ScanCut>& cuts, const Vec3& voxel) noexcept {
  for (const ScanCut& cut : cuts) {
    if (cut.covers(voxel)) return true;
  }
  return false;
}

}  // namespace carpus::fluoroscopy
