// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Along each row of voxels the surface is crossed; the winding number counts crossings in and out.
// Whether a row meets a triangle is decided by exact orientations with a symbolic shift of the row
// off vertices and edges, so that crossings always pair up.
#include "geometry/voxels_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/predicates.hpp"

namespace carpus {
namespace {

/// A row of voxels, parallel to x, passes through the surface.
struct Crossing {
  std::uint32_t row;  ///< k * size_y + j
  int turn;           ///< +1 into the body, -1 out of it
  double x;
};

/// Side of the directed line a-b on which the point lies after a shift by (e, e^2), e -> 0: never 0
/// for a != b, and opposite for b-a.
int shifted_side(const Vec2& a, const Vec2& b, const Vec2& p) {
  if (const int side = orient2d(a, b, p); side != 0) return side;
  if (b.y != a.y) return b.y > a.y ? -1 : 1;
  return b.x > a.x ? 1 : -1;
}

void cross_rows(const GridGeometry& grid,
                const std::array<Vec3, 3>& t,
                std::vector<Crossing>& crossings) {
  const std::array<Vec2, 3> q{{{t[0].y, t[0].z}, {t[1].y, t[1].z}, {t[2].y, t[2].z}}};
  const int facing = orient2d(q[0], q[1], q[2]);
  if (facing == 0) return;  // seen edge-on: its neighbours account for the row
  const auto range = [&](std::size_t axis, double low, double high) {
    const double first = std::ceil((low - grid.origin[axis]) / grid.spacing[axis]) - 1;
    const double last = std::floor((high - grid.origin[axis]) / grid.spacing[axis]) + 1;
    return std::pair{std::max(0, static_cast<int>(first)),
                     std::min(grid.size[axis] - 1, static_cast<int>(last))};
  };
  const auto [j0, j1] =
      range(1, std::min({t[0].y, t[1].y, t[2].y}), std::max({t[0].y, t[1].y, t[2].y}));
  const auto [k0, k1] =
      range(2, std::min({t[0].z, t[1].z, t[2].z}), std::max({t[0].z, t[1].z, t[2].z}));
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  for (int k = k0; k <= k1; ++k) {
    for (int j = j0; j <= j1; ++j) {
      const Vec2 p{grid.origin.y + j * grid.spacing.y, grid.origin.z + k * grid.spacing.z};
      bool meets = true;
      for (std::size_t i = 0; i < 3 && meets; ++i) {
        meets = shifted_side(q[i], q[(i + 1) % 3], p) == facing;
      }
      if (!meets) continue;
      // On the plane of the triangle, kept within it where the plane is nearly parallel to x.
      const double offset = (normal.y * (p.x - t[0].y) + normal.z * (p.y - t[0].z)) / normal.x;
      const double x =
          std::clamp(std::isfinite(offset) ? t[0].x - offset : t[0].x,
                     std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}));
      crossings.push_back({static_cast<std::uint32_t>(k * grid.size[1] + j), -facing, x});
    }
  }
}

}  // namespace

Grid<std::uint8_t> voxels_inside(const TriangleMesh& surface, const GridGeometry& grid) {
  std::vector<Crossing> crossings;
  for (const Triangle& t : surface.facets) {
    cross_rows(grid, {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]},
               crossings);
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.row, a.x, a.turn) < std::tie(b.row, b.x, b.turn);
  });
  Grid<std::uint8_t> inside(grid);
  const auto nx = static_cast<std::size_t>(grid.size[0]);
  for (std::size_t c = 0; c < crossings.size();) {
    const std::uint32_t row = crossings[c].row;
    int winding = 0;
    for (std::size_t i = 0; i < nx; ++i) {
      const double x = grid.origin.x + static_cast<double>(i) * grid.spacing.x;
      while (c < crossings.size() && crossings[c].row == row && crossings[c].x <= x) {
        winding += crossings[c++].turn;
      }
      inside[row * nx + i] = winding != 0 ? 1 : 0;
    }
    while (c < crossings.size() && crossings[c].row == row) ++c;
  }
  return inside;
}

}  // namespace carpus
