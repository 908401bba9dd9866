// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Magnitude: nearest triangle through a tree of boxes. Blocks of 8^3 voxels whose centre is farther
// than the band (plus half the block) are filled at once; within a block each search starts from
// the triangle found for the voxel before.
// Sign: geometry/voxels_inside.hpp, by winding numbers. (Signs from the nearest triangle's normal
// [baerentzen2005signed] would do on perfect meshes; they fail on slivers.)
#include "fields/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/aabb.hpp"
#include "geometry/voxels_inside.hpp"

namespace carpus::fields {
namespace {

constexpr int kBlock = 8;

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
        inside_(voxels_inside(mesh, field_.geometry())) {}

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
  Grid<std::uint8_t> inside_;
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
