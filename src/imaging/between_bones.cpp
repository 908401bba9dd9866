// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/between_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vec3.hpp"

namespace carpus::imaging {
namespace {

/// Steps in voxels, one of each pair of opposite directions.
constexpr std::array<VoxelIndex, 13> kDirections{{{1, 0, 0},
                                                  {0, 1, 0},
                                                  {0, 0, 1},
                                                  {1, 1, 0},
                                                  {1, -1, 0},
                                                  {1, 0, 1},
                                                  {1, 0, -1},
                                                  {0, 1, 1},
                                                  {0, 1, -1},
                                                  {1, 1, 1},
                                                  {1, 1, -1},
                                                  {1, -1, 1},
                                                  {1, -1, -1}}};

}  // namespace

bool lies_between_bones(const GridView<const float>& image,
                        const VoxelIndex& v,
                        double reach_mm,
                        float rise) {
  const GridGeometry& g = image.geometry();
  const float wanted = image[v] + rise;
  const auto rises = [&](const VoxelIndex& d, int sign, int steps) {
    for (int k = 1; k <= steps; ++k) {
      const VoxelIndex n{v.x + sign * k * d.x, v.y + sign * k * d.y, v.z + sign * k * d.z};
      if (!g.contains(n)) return false;
      if (image[n] >= wanted) return true;
    }
    return false;
  };
  return std::any_of(kDirections.begin(), kDirections.end(), [&](const VoxelIndex& d) {
    const double step_mm = length({d.x * g.spacing.x, d.y * g.spacing.y, d.z * g.spacing.z});
    const int steps = std::max(1, static_cast<int>(std::lround(reach_mm / step_mm)));
    return rises(d, 1, steps) && rises(d, -1, steps);
  });
}

}  // namespace carpus::imaging
