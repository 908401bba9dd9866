// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Components: runs along x are joined with the runs they touch in the row before and the slice
// before (union-find), which visits memory in order [rosenfeld1966sequential].
#include "imaging/binary_mask.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace carpus::imaging {
namespace {

struct Run {
  int begin = 0;
  int end = 0;
};

/// Forest of runs; the root of a tree is its smallest index.
class Forest {
 public:
  void add() { parent_.push_back(static_cast<std::uint32_t>(parent_.size())); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct RunTable {
  std::vector<Run> runs;
  std::vector<std::uint32_t> first_of_row;  ///< rows + 1 entries
};

RunTable find_runs(const GridView<const std::uint8_t>& mask) {
  const int nx = mask.geometry().size[0];
  const std::size_t rows = nx == 0 ? 0 : mask.values().size() / static_cast<std::size_t>(nx);
  RunTable table;
  for (std::size_t row = 0; row < rows; ++row) {
    table.first_of_row.push_back(static_cast<std::uint32_t>(table.runs.size()));
    const std::uint8_t* value = mask.values().data() + row * static_cast<std::size_t>(nx);
    for (int x = 0; x < nx;) {
      if (value[x] == 0) {
        ++x;
        continue;
      }
      const int begin = x;
      while (x < nx && value[x] != 0) ++x;
      table.runs.push_back({begin, x});
    }
  }
  table.first_of_row.push_back(static_cast<std::uint32_t>(table.runs.size()));
  return table;
}

void join_rows(const RunTable& table, std::size_t row_a, std::size_t row_b, Forest& forest) {
  std::uint32_t a = table.first_of_row[row_a];
  std::uint32_t b = table.first_of_row[row_b];
  const std::uint32_t a_end = table.first_of_row[row_a + 1];
  const std::uint32_t b_end = table.first_of_row[row_b + 1];
  while (a < a_end && b < b_end) {
    const Run& ra = table.runs[a];
    const Run& rb = table.runs[b];
    if (ra.begin < rb.end && rb.begin < ra.end) forest.join(a, b);
    (ra.end < rb.end ? a : b)++;
  }
}

/// One step of erosion (`keep` = 0) or dilation (`keep` = 1) with the six-neighbour cross.
Grid<std::uint8_t> cross_step(const GridView<const std::uint8_t>& mask, bool dilate) {
  const GridGeometry& g = mask.geometry();
  Grid<std::uint8_t> result(g);
  const auto [nx, ny, nz] = g.size;
  const std::size_t dy = static_cast<std::size_t>(nx);
  const std::size_t dz = dy * static_cast<std::size_t>(ny);
  const bool wanted = dilate;
  std::size_t i = 0;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x, ++i) {
        const auto hit = [&](std::size_t j) { return (mask[j] != 0) == wanted; };
        const bool found = hit(i) || (x > 0 && hit(i - 1)) || (x + 1 < nx && hit(i + 1)) ||
                           (y > 0 && hit(i - dy)) || (y + 1 < ny && hit(i + dy)) ||
                           (z > 0 && hit(i - dz)) || (z + 1 < nz && hit(i + dz));
        result[i] = found == dilate ? 1 : 0;
      }
    }
  }
  return result;
}

}  // namespace

std::uint32_t Components::largest() const {
  return static_cast<std::uint32_t>(std::max_element(voxels.begin(), voxels.end()) -
                                    voxels.begin());
}

Components connected_components(const GridView<const std::uint8_t>& mask) {
  const GridGeometry& g = mask.geometry();
  const RunTable table = find_runs(mask);
  Forest forest;
  for (std::size_t i = 0; i < table.runs.size(); ++i) forest.add();
  const std::size_t rows = table.first_of_row.size() - 1;
  const auto ny = static_cast<std::size_t>(g.size[1]);
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % ny != 0) join_rows(table, row - 1, row, forest);
    if (row >= ny) join_rows(table, row - ny, row, forest);
  }
  Components result{Grid<std::uint32_t>(g), {0}};
  std::vector<std::uint32_t> label_of(table.runs.size(), 0);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::uint32_t r = table.first_of_row[row]; r < table.first_of_row[row + 1]; ++r) {
      std::uint32_t& label = label_of[forest.root(r)];
      if (label == 0) {
        label = static_cast<std::uint32_t>(result.voxels.size());
        result.voxels.push_back(0);
      }
      const Run& run = table.runs[r];
      const std::size_t base = row * static_cast<std::size_t>(g.size[0]);
      for (int x = run.begin; x < run.end; ++x) {
        result.labels[base + static_cast<std::size_t>(x)] = label;
      }
      result.voxels[label] += static_cast<std::size_t>(run.end - run.begin);
    }
  }
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
