// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One order of axes for every file: a converter may store the same voxels with axes swapped or
// reversed (dcm2niix reverses y). Voxels keep their place in the patient; only memory is reordered.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::case_io {

/// For each axis of the new grid: which old axis it is and whether it runs the other way.
struct AxisOrder {
  std::array<std::size_t, 3> source{0, 1, 2};
  std::array<bool, 3> is_reversed{false, false, false};

  [[nodiscard]] bool is_identity() const {
    return source == std::array<std::size_t, 3>{0, 1, 2} && !is_reversed[0] && !is_reversed[1] &&
           !is_reversed[2];
  }
};

/// The order in which the axes come nearest to +x, +y, +z of the patient (the permutation with the
/// greatest trace of absolute cosines, the first of equals).
[[nodiscard]] inline AxisOrder canonical_order(const Mat3& direction) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  AxisOrder best;
  double greatest = -1;
  for (const auto& order : kOrders) {
    double trace = 0;
    for (std::size_t i = 0; i < 3; ++i) trace += std::abs(direction.column(order[i])[i]);
    if (trace > greatest + 1e-9) {  // equals: keep the first, whatever the rounding
      greatest = trace;
      best.source = order;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    best.is_reversed[i] = direction.column(best.source[i])[i] < 0;
  }
  return best;
}

/// Reorders memory so that the axes run in the canonical order.
template <typename T>
[[nodiscard]] Grid<T> with_canonical_axes(Grid<T> grid) {
  const GridGeometry& old = grid.geometry();
  const AxisOrder order = canonical_order(old.direction);
  if (order.is_identity()) return grid;
  GridGeometry g;
  std::array<Vec3, 3> columns;
  Vec3 first_voxel{};  // old coordinates of the new voxel (0, 0, 0)
  const std::array<std::ptrdiff_t, 3> old_step{
      1, old.size[0], static_cast<std::ptrdiff_t>(old.size[0]) * old.size[1]};
  std::array<std::ptrdiff_t, 3> step{};
  std::ptrdiff_t start = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t s = order.source[i];
    const double sign = order.is_reversed[i] ? -1.0 : 1.0;
    g.size[i] = old.size[s];
    g.spacing[i] = old.spacing[s];
    columns[i] = old.direction.column(s) * sign;
    step[i] = old_step[s] * (order.is_reversed[i] ? -1 : 1);
    if (order.is_reversed[i]) {
      first_voxel[s] = old.size[s] - 1;
      start += old_step[s] * (old.size[s] - 1);
    }
  }
  g.origin = old.patient_from_voxel(first_voxel);
  g.direction = Mat3::from_columns(columns[0], columns[1], columns[2]);
  std::vector<T> values(g.voxel_count());
  std::size_t to = 0;
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      std::ptrdiff_t from = start + z * step[2] + y * step[1];
      for (int x = 0; x < g.size[0]; ++x, from += step[0]) {
        values[to++] = grid[static_cast<std::size_t>(from)];
      }
    }
  }
  return Grid<T>(g, std::move(values));
}

}  // namespace carpus::case_io
