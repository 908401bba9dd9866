// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Masks (0 or 1 per voxel): connected components, opening by one voxel, the box that holds them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/grid.hpp"
#include "imaging/block_view.hpp"

namespace carpus::imaging {

/// Components of the voxels where the mask is not 0, joined over faces (6 neighbours).
struct Components {
  Grid<std::uint32_t> labels;       ///< 0 = outside; else 1.. in the order of their first voxel
  std::vector<std::size_t> voxels;  ///< [label] number of voxels; [0] = 0
  /// Label of the largest (the first of equals), 0 if there is none.
  [[nodiscard]] std::uint32_t largest() const;
};
[[nodiscard]] Components connected_components(const GridView<const std::uint8_t>& mask);

/// Keeps a voxel only if the six-neighbour cross fits around some place that covers it: removes
/// bridges and crumbs one voxel thick. Beyond the volume counts as set.
[[nodiscard]] Grid<std::uint8_t> opened_by_one_voxel(const GridView<const std::uint8_t>& mask);

/// The smallest block of voxels above `threshold`, grown by margin_mm and cut at the volume; empty
/// if there are none.
[[nodiscard]] std::optional<VoxelBox> box_above(const GridView<const float>& image,
                                                double threshold,
                                                double margin_mm);

/// The block as a grid of its own, in the same place in the patient.
template <typename T>
[[nodiscard]] Grid<T> crop(const GridView<const T>& image, const VoxelBox& box) {
  Grid<T> result(block_geometry(image.geometry(), box));
  std::size_t out = 0;
  for (int z = box.low.z; z <= box.high.z; ++z) {
    for (int y = box.low.y; y <= box.high.y; ++y) {
      for (int x = box.low.x; x <= box.high.x; ++x) result[out++] = image[VoxelIndex{x, y, z}];
    }
  }
  return result;
}

}  // namespace carpus::imaging
