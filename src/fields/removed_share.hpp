// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How much of each voxel of bone is gone: what picture and beam need of the cuts. The simulation
// tells changed bricks (CutTissue::take_changes), small plain values that a queue may carry to
// another thread; there a grid takes them in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::fields {

class CutField;
struct CutBrick;

/// Voxels of one brick of a cut field, by axis; each is 2 x 2 x 2 of its cells: as wide as a cell
/// of the bone's field.
inline constexpr int kShareVoxels = 2;

/// One brick's shares as they are now.
struct ShareChange {
  std::uint32_t body = 0;
  std::uint32_t brick = 0;  ///< x fastest in the body's table of bricks
  /// 0 (whole) to 255 (nothing left), x fastest. All 0: the brick is uncut again.
  std::array<std::uint8_t, 8> share{};
};

/// Shares of a brick: the mean over a voxel's cells of what a plane cut leaves of each.
[[nodiscard]] std::array<std::uint8_t, 8> shares_of(const CutBrick& brick,
                                                    double spacing_mm) noexcept;

/// One body's shares on a whole grid, kept by whoever looks at them.
class RemovedShareGrid {
 public:
  /// Nothing removed.
  explicit RemovedShareGrid(const CutField& field);

  /// Patient of the geometry is frame Bone: the bone as scanned.
  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] std::span<const std::uint8_t> share() const noexcept { return share_; }

  /// Takes in a change of this body. False: the brick does not exist. No allocation.
  bool apply(const ShareChange& change) noexcept;

  /// Voxels low <= index < high that changed since this was last asked; empty: high is 0.
  struct Box {
    std::array<int, 3> low{0, 0, 0};
    std::array<int, 3> high{0, 0, 0};
  };
  [[nodiscard]] Box take_changed_box() noexcept;

  /// Bone that is gone, by all shares [mm^3]; bone or not, whatever tools went through.
  [[nodiscard]] double removed_volume_mm3() const noexcept;

 private:
  GridGeometry geometry_;
  std::array<int, 3> bricks_by_axis_{};
  std::vector<std::uint8_t> share_;
  Box changed_;
};

/// Density of what fills a hole: blood, saline, debris; soft tissue's [HU].
inline constexpr double kHoleHu = 40.0;

/// Density where a share of the tissue is gone [HU].
[[nodiscard]] constexpr double remaining_hu(double hu, double removed_share) noexcept {
  return hu + (kHoleHu - hu) * removed_share;
}

}  // namespace carpus::fields
