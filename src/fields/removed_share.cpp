// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/removed_share.hpp"

#include <algorithm>

#include "fields/cut_field.hpp"

namespace carpus::fields {

std::array<std::uint8_t, 8> shares_of(const CutBrick& brick, double spacing_mm) noexcept {
  // Eight times a cell's mean is the sum of its nodes; a cell holds a plane cut at mean / spacing
  // from its middle.
  const double per_sum = kCutUnitMm / (8 * spacing_mm);
  std::array<double, 8> sum{};
  for (int z = 0; z < CutBrick::kCells; ++z) {
    for (int y = 0; y < CutBrick::kCells; ++y) {
      for (int x = 0; x < CutBrick::kCells; ++x) {
        int nodes = 0;
        for (int corner = 0; corner < 8; ++corner) {
          nodes +=
              brick.node[CutBrick::offset_of(x + corner % 2, y + corner / 2 % 2, z + corner / 4)];
        }
        const auto voxel = static_cast<std::size_t>((z / 2 * 2 + y / 2) * 2 + x / 2);
        sum[voxel] += std::clamp(0.5 + nodes * per_sum, 0.0, 1.0);
      }
    }
  }
  std::array<std::uint8_t, 8> share{};
  for (std::size_t i = 0; i < share.size(); ++i) {
    share[i] = static_cast<std::uint8_t>(sum[i] * (255.0 / 8) + 0.5);
  }
  return share;
}

RemovedShareGrid::RemovedShareGrid(const CutField& field)
    : bricks_by_axis_(field.bricks_by_axis()) {
  const double width = kCutCellsPerCell * field.spacing_mm();
  geometry_.spacing = {width, width, width};
  geometry_.origin = field.origin() + Vec3{width / 2, width / 2, width / 2};
  for (std::size_t a = 0; a < 3; ++a) geometry_.size[a] = kShareVoxels * bricks_by_axis_[a];
  share_.assign(geometry_.voxel_count(), 0);
}

bool RemovedShareGrid::apply(const ShareChange& change) noexcept {
  const auto nx = static_cast<std::uint32_t>(bricks_by_axis_[0]);
  const auto ny = static_cast<std::uint32_t>(bricks_by_axis_[1]);
  const auto nz = static_cast<std::uint32_t>(bricks_by_axis_[2]);
  if (change.brick >= nx * ny * nz) return false;
  const VoxelIndex low{static_cast<int>(change.brick % nx) * kShareVoxels,
                       static_cast<int>(change.brick / nx % ny) * kShareVoxels,
                       static_cast<int>(change.brick / (nx * ny)) * kShareVoxels};
  for (int i = 0; i < 8; ++i) {
    const VoxelIndex voxel{low.x + i % 2, low.y + i / 2 % 2, low.z + i / 4};
    share_[geometry_.offset_of(voxel)] = change.share[static_cast<std::size_t>(i)];
  }
  const std::array<int, 3> first{low.x, low.y, low.z};
  const bool is_empty = changed_.high[0] == 0;
  for (std::size_t a = 0; a < 3; ++a) {
    changed_.low[a] = is_empty ? first[a] : std::min(changed_.low[a], first[a]);
    changed_.high[a] = std::max(changed_.high[a], first[a] + kShareVoxels);
  }
  return true;
}

RemovedShareGrid::Box RemovedShareGrid::take_changed_box() noexcept {
  const Box box = changed_;
  changed_ = {};
  return box;
}

double RemovedShareGrid::removed_volume_mm3() const noexcept {
  std::uint64_t sum = 0;
  for (const std::uint8_t s : share_) sum += s;
  return static_cast<double>(sum) / 255 * geometry_.voxel_volume_mm3();
}

}  // namespace carpus::fields
