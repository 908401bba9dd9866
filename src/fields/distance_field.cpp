// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Magnitude: nearest triangle through a tree of boxes. Blocks of 8^3 voxels whose centre is farther
// than the band (plus half the block) are filled at once; within a block each search starts from
// the triangle found for the voxel before.
// Sign: along each row of voxels the surface is crossed; the winding number counts crossings in and
// out. Whether a row meets a triangle is decided by exact orientations with a symbolic shift of the
// row off vertices and edges, so that crossings always pair up. (Signs from the nearest triangle's
// normal [baerentzen2005signed] would do on perfect meshes; they fail on slivers.)
#include "fields/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/aabb.hpp"
#include "geometry/predicates.hpp"

namespace carpus::fields {
namespace {

constexpr int kBlock = 8;

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

/// 1 for voxels inside the surface.
std::vector<std::uint8_t> find_inside(const TriangleMesh& mesh, const GridGeometry& grid) {
  std::vector<Crossing> crossings;
  for (const Triangle& t : mesh.facets) {
    cross_rows(grid, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, crossings);
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.row, a.x, a.turn) < std::tie(b.row, b.x, b.turn);
  });
  std::vector<std::uint8_t> inside(grid.voxel_count(), 0);
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

GridGeometry grid_around(const TriangleMesh& mesh, const DistanceFieldOptions& options) {
  const Aabb box = bounds_of(mesh.vertices).grown(options.band_mm);
  GridGeometry grid;
  grid.spacing = {options.spacing_mm, options.spacing_mm, options.spacing_mm};
  double voxels = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = std::floor(box.low[axis] / options.spacing_mm) * options.spacing_mm;
    const double count = std::ceil((box.high[axis] - grid.origin[axis]) / options.spacing_mm) + 1;
    voxels *= count;
    if (!(voxels <= static_cast<double>(kMaxFieldVoxels))) {
      throw InvalidInput("distance field: more than " + std::to_string(kMaxFieldVoxels) +
                         " voxels; choose a larger spacing_mm");
    }
    grid.size[axis] = static_cast<int>(count);
  }
  return grid;
}

class FieldBuilder {
 public:
  FieldBuilder(const TriangleMesh& mesh, const DistanceFieldOptions& options)
      : tree_(mesh),
        band_(options.band_mm),
        field_(grid_around(mesh, options)),
        inside_(find_inside(mesh, field_.geometry())) {}

  Grid<float> run() {
    const auto& size = field_.geometry().size;
    std::array<std::size_t, 3> blocks{};
    for (std::size_t a = 0; a < 3; ++a) {
      blocks[a] = static_cast<std::size_t>((size[a] + kBlock - 1) / kBlock);
    }
    parallel_for(blocks[0] * blocks[1] * blocks[2], 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        fill_block({static_cast<int>(b % blocks[0]) * kBlock,
                    static_cast<int>(b / blocks[0] % blocks[1]) * kBlock,
                    static_cast<int>(b / (blocks[0] * blocks[1])) * kBlock});
      }
    });
    return std::move(field_);
  }

 private:
  [[nodiscard]] Vec3 position(double x, double y, double z) const {
    const GridGeometry& g = field_.geometry();
    return {g.origin.x + x * g.spacing.x, g.origin.y + y * g.spacing.y,
            g.origin.z + z * g.spacing.z};
  }

  void fill_block(const VoxelIndex& low) {
    const auto& size = field_.geometry().size;
    const double half = 0.5 * (kBlock - 1);
    const double reach = std::sqrt(3.0) * half * field_.geometry().spacing.x;
    const auto near_centre =
        tree_.nearest(position(low.x + half, low.y + half, low.z + half), band_ + reach);
    std::optional<std::uint32_t> hint;
    if (near_centre) hint = near_centre->facet;
    for (int k = low.z; k < std::min(low.z + kBlock, size[2]); ++k) {
      for (int j = low.y; j < std::min(low.y + kBlock, size[1]); ++j) {
        for (int i = low.x; i < std::min(low.x + kBlock, size[0]); ++i) {
          double distance = band_;
          if (near_centre) {
            if (const auto found = tree_.nearest(position(i, j, k), band_, hint)) {
              distance = std::sqrt(found->squared_distance);
              hint = found->facet;
            }
          }
          const std::size_t at = field_.geometry().offset_of({i, j, k});
          field_[at] = static_cast<float>(inside_[at] != 0 ? -distance : distance);
        }
      }
    }
  }

  TriangleTree tree_;
  double band_;
  Grid<float> field_;
  std::vector<std::uint8_t> inside_;
};

}  // namespace

Grid<float> build_distance_field(const TriangleMesh& mesh, const DistanceFieldOptions& options) {
  if (!(options.spacing_mm > 0 && options.band_mm > 0)) {
    throw InvalidInput("distance field: spacing_mm and band_mm must be positive");
  }
  if (check_surface(mesh) != SurfaceStatus::Ok) {
    throw InvalidInput("distance field: the surface is not closed and consistently oriented");
  }
  return FieldBuilder(mesh, options).run();
}

}  // namespace carpus::fields
