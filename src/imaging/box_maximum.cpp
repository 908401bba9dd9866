// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/box_maximum.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.hpp"

namespace carpus::imaging {
namespace {

/// Replaces each row by the maximum over `radius` rows on both sides along one axis; `group` values
/// lie side by side, `length` groups follow each other along the axis.
void maximum_along(std::span<float> block, std::size_t group, std::size_t length, int radius) {
  const std::vector<float> source(block.begin(), block.end());
  const auto n = static_cast<int>(length);
  for (int i = 0; i < n; ++i) {
    float* out = block.data() + static_cast<std::size_t>(i) * group;
    for (int j = std::max(0, i - radius); j <= std::min(n - 1, i + radius); ++j) {
      const float* in = source.data() + static_cast<std::size_t>(j) * group;
      for (std::size_t k = 0; k < group; ++k) out[k] = std::max(out[k], in[k]);
    }
  }
}

}  // namespace

Grid<float> box_maximum(const GridView<const float>& image, double reach_mm) {
  const GridGeometry& g = image.geometry();
  Grid<float> result(g, {image.values().begin(), image.values().end()});
  const auto nx = static_cast<std::size_t>(g.size[0]);
  const auto ny = static_cast<std::size_t>(g.size[1]);
  const auto nz = static_cast<std::size_t>(g.size[2]);
  const auto radius = [&](std::size_t axis) {
    return static_cast<int>(std::lround(reach_mm / g.spacing[axis]));
  };
  const std::span<float> all = result.values();
  parallel_for(nz, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t z = begin; z < end; ++z) {
      const std::span<float> slice = all.subspan(z * nx * ny, nx * ny);
      maximum_along(slice, nx, ny, radius(1));
      for (std::size_t y = 0; y < ny; ++y)
        maximum_along(slice.subspan(y * nx, nx), 1, nx, radius(0));
    }
  });
  // Along z, one row at a time so that threads write apart.
  const std::vector<float> source(all.begin(), all.end());
  const int rz = radius(2);
  parallel_for(nz, 4, [&](std::size_t begin, std::size_t end) {
    for (auto z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
      float* out = all.data() + static_cast<std::size_t>(z) * nx * ny;
      for (int j = std::max(0, z - rz); j <= std::min(static_cast<int>(nz) - 1, z + rz); ++j) {
        const float* in = source.data() + static_cast<std::size_t>(j) * nx * ny;
        for (std::size_t k = 0; k < nx * ny; ++k) out[k] = std::max(out[k], in[k]);
      }
    }
  });
  return result;
}

}  // namespace carpus::imaging
