// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which voxels are neighbours of a voxel: those that share a face, an edge or a corner with it.
// Source: [rosenfeld1966sequential].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::imaging {

/// What a neighbour shares with a voxel, at least.
enum class Connectivity : std::uint8_t {
  Faces,    ///< 6 neighbours in a volume, 4 in a slice
  Edges,    ///< 18 in a volume, 8 in a slice
  Corners,  ///< 26 in a volume, 8 in a slice
};

/// Where neighbours are looked for.
enum class FloodSpace : std::uint8_t {
  Volume,  ///< in all directions
  Slices,  ///< within the axial slice (equal z), as in the thesis
};

/// The neighbours of every voxel of one grid.
class Neighbourhood {
 public:
  Neighbourhood(const GridGeometry& geometry, FloodSpace space, Connectivity connectivity);

  /// Calls visit(j) for each neighbour j of a voxel of which all lie in the grid; the nearer kinds
  /// first; faces in the order -x +x -y +y -z +z.
  template <typename Visit>
  void for_each_of_inner(std::size_t i, const Visit& visit) const {
    for (const std::ptrdiff_t step : strides_) {
      visit(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + step));
    }
  }
  /// The k-th of them.
  [[nodiscard]] std::size_t of_inner(std::size_t i, int k) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) +
                                    strides_[static_cast<std::size_t>(k)]);
  }
  /// From an inner voxel to one of each row along x that holds neighbours of it, in memory.
  [[nodiscard]] std::span<const std::ptrdiff_t> rows() const { return rows_; }
  /// Calls visit(j) for each neighbour j of any voxel; those beyond the grid are left out.
  template <typename Visit>
  void for_each(std::size_t i, const Visit& visit) const {
    const VoxelIndex v = geometry_.index_of(i);
    for (const VoxelIndex& step : steps_) {
      const VoxelIndex n{v.x + step.x, v.y + step.y, v.z + step.z};
      if (geometry_.contains(n)) visit(geometry_.offset_of(n));
    }
  }
  [[nodiscard]] std::size_t count() const { return steps_.size(); }

 private:
  GridGeometry geometry_;
  bool in_slices_;
  std::vector<VoxelIndex> steps_;
  std::vector<std::ptrdiff_t> strides_;  ///< of the same steps, in memory
  std::vector<std::ptrdiff_t> rows_;
};

}  // namespace carpus::imaging
