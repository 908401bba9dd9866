// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/neighbourhood.hpp"

#include <algorithm>
#include <cstdlib>

namespace carpus::imaging {
namespace {

/// How many of the three axes a step to such a neighbour may change.
int most_axes(Connectivity connectivity) { return static_cast<int>(connectivity) + 1; }

}  // namespace

Neighbourhood::Neighbourhood(const GridGeometry& geometry,
                             FloodSpace space,
                             Connectivity connectivity)
    : geometry_(geometry), in_slices_(space == FloodSpace::Slices) {
  for (int axes = 1; axes <= most_axes(connectivity); ++axes) {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          if (std::abs(x) + std::abs(y) + std::abs(z) != axes) continue;
          if (!in_slices_ || z == 0) steps_.push_back({x, y, z});
        }
      }
    }
    // Faces: along x first, then y, then z; the other kinds as found.
    if (axes == 1) {
      std::stable_sort(steps_.begin(), steps_.end(), [](const VoxelIndex& a, const VoxelIndex& b) {
        return std::abs(a.y) + 2 * std::abs(a.z) < std::abs(b.y) + 2 * std::abs(b.z);
      });
    }
  }
  const auto dy = static_cast<std::ptrdiff_t>(geometry.size[0]);
  const std::ptrdiff_t dz = dy * geometry.size[1];
  for (const VoxelIndex& s : steps_) {
    strides_.push_back(s.x + s.y * dy + s.z * dz);
    const std::ptrdiff_t row = s.y * dy + s.z * dz;
    if (std::find(rows_.begin(), rows_.end(), row) == rows_.end()) rows_.push_back(row);
  }
}

}  // namespace carpus::imaging
