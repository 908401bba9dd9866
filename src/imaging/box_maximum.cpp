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

Grid<float> box_maximum(Grid<float> image, double reach_mm) {
  const GridGeometry& g = image.geometry();
  const auto nx = static_cast<std::size_t>(g.size[0]);
  const auto ny = static_cast<std::size_t>(g.size[1]);
  const auto nz = static_cast<std::size_t>(g.size[2]);
  const auto radius = [&](std::size_t axis) {
    return static_cast<int>(std::lround(reach_mm / g.spacing[axis]));
  };
  const std::span<float> all = image.values();
  parallel_for(nz, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t z = begin; z < end; ++z) {
      const std::span<float> slice = all.subspan(z * nx * ny, nx * ny);
      maximum_along(slice, nx, ny, radius(1));
      for (std::size_t y = 0; y < ny; ++y)
        maximum_along(slice.subspan(y * nx, nx), 1, nx, radius(0));
    }
  });
  // Along z, one row of all slices at a time.
  parallel_for(ny, 4, [&](std::size_t begin, std::size_t end) {
    std::vector<float> upright(nx * nz);
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t z = 0; z < nz; ++z) {
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>((z * ny + y) * nx), nx,
                    upright.begin() + static_cast<std::ptrdiff_t>(z * nx));
      }
      maximum_along(upright, nx, nz, radius(2));
      for (std::size_t z = 0; z < nz; ++z) {
        std::copy_n(upright.begin() + static_cast<std::ptrdiff_t>(z * nx), nx,
                    all.begin() + static_cast<std::ptrdiff_t>((z * ny + y) * nx));
      }
    }
  });
  return image;
}

}  // namespace carpus::imaging
