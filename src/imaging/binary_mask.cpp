// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/binary_mask.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/parallel.hpp"
#include "imaging/detail/run_components.hpp"

namespace carpus::imaging {
namespace {

/// One step of erosion (`keep` = 0) or dilation (`keep` = 1) with the six-neighbour cross.
Grid<std::uint8_t> cross_step(const GridView<const std::uint8_t>& mask, bool dilate) {
  const GridGeometry& g = mask.geometry();
  Grid<std::uint8_t> result(g);
  const auto [nx, ny, nz] = g.size;
  const std::size_t dy = static_cast<std::size_t>(nx);
  const std::size_t dz = dy * static_cast<std::size_t>(ny);
  const bool wanted = dilate;
  const auto step_slice = [&, nx = nx, ny = ny, nz = nz](int z) {
    std::size_t i = static_cast<std::size_t>(z) * dz;
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x, ++i) {
        const auto hit = [&](std::size_t j) { return (mask[j] != 0) == wanted; };
        const bool found = hit(i) || (x > 0 && hit(i - 1)) || (x + 1 < nx && hit(i + 1)) ||
                           (y > 0 && hit(i - dy)) || (y + 1 < ny && hit(i + dy)) ||
                           (z > 0 && hit(i - dz)) || (z + 1 < nz && hit(i + dz));
        result[i] = found == dilate ? 1 : 0;
      }
    }
  };
  parallel_for(static_cast<std::size_t>(nz), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t z = begin; z < end; ++z) step_slice(static_cast<int>(z));
  });
  return result;
}

}  // namespace

std::uint32_t Components::largest() const {
  return static_cast<std::uint32_t>(std::max_element(voxels.begin(), voxels.end()) -
                                    voxels.begin());
}

Components connected_components(const GridView<const std::uint8_t>& mask) {
  const detail::RunComponents runs(mask, [](std::uint8_t value) { return value != 0; });
  Components result{Grid<std::uint32_t>(mask.geometry()), runs.voxels()};
  runs.for_each([&](std::size_t first, std::size_t end, std::uint32_t component) {
    for (std::size_t i = first; i < end; ++i) result.labels[i] = component;
  });
  return result;
}

Grid<std::uint8_t> opened_by_one_voxel(const GridView<const std::uint8_t>& mask) {
  const Grid<std::uint8_t> eroded = cross_step(mask, false);
  return cross_step(eroded.view(), true);
}

std::optional<VoxelBox> box_above(const GridView<const float>& image,
                                  double threshold,
                                  double margin_mm) {
  const GridGeometry& g = image.geometry();
  VoxelBox box{{g.size[0], g.size[1], g.size[2]}, {-1, -1, -1}};
  std::size_t i = 0;
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = 0; x < g.size[0]; ++x, ++i) {
        if (!(static_cast<double>(image[i]) > threshold)) continue;
        box.low = {std::min(box.low.x, x), std::min(box.low.y, y), std::min(box.low.z, z)};
        box.high = {std::max(box.high.x, x), std::max(box.high.y, y), std::max(box.high.z, z)};
      }
    }
  }
  if (box.high.x < 0) return std::nullopt;
  const auto grown = [&](int low, int high, std::size_t axis) {
    const int margin = static_cast<int>(std::ceil(margin_mm / g.spacing[axis]));
    return std::pair(std::max(0, low - margin), std::min(g.size[axis] - 1, high + margin));
  };
  std::tie(box.low.x, box.high.x) = grown(box.low.x, box.high.x, 0);
  std::tie(box.low.y, box.high.y) = grown(box.low.y, box.high.y, 1);
  std::tie(box.low.z, box.high.z) = grown(box.low.z, box.high.z, 2);
  return box;
}

}  // namespace carpus::imaging
