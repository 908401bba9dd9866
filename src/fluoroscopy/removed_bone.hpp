// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an instrument took out of a bone, as the picture is told of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"

namespace carpus::fluoroscopy {

/// Share of each voxel that is gone, 0 (whole) to 255 (nothing left), on a grid of any spacing
/// around the body. The geometry's Patient is frame Bone: the bone as scanned. Values are read
/// during the call that takes them and not kept.
struct RemovedBone {
  GridGeometry geometry;
  std::span<const std::uint8_t> share;
};

/// Voxels low <= index < high on each axis.
struct IndexBox {
  std::array<int, 3> low{0, 0, 0};
  std::array<int, 3> high{0, 0, 0};

  [[nodiscard]] constexpr bool is_empty() const noexcept {
    return !(low[0] < high[0] && low[1] < high[1] && low[2] < high[2]);
  }
  constexpr bool operator==(const IndexBox&) const = default;
};

/// All voxels of a grid.
[[nodiscard]] constexpr IndexBox whole_of(const GridGeometry& geometry) noexcept {
  return {{0, 0, 0}, geometry.size};
}

}  // namespace carpus::fluoroscopy
