// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Magnitude: blocks are halved down to single voxels; each hands on the facets that may be nearest
// to any of its voxels (detail/facet_discs.hpp). One whose centre is farther than the band and half
// the block is filled at once.
// Sign: geometry/voxels_inside.hpp, by winding numbers. (Signs from the nearest triangle's normal
// [baerentzen2005signed] would do on perfect meshes; they fail on slivers.)
#include "fields/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fields/detail/facet_discs.hpp"
#include "geometry/aabb.hpp"
#include "geometry/voxels_inside.hpp"

namespace carpus::fields {
namespace {

constexpr std::size_t kLevels = 4;
constexpr int kBlock = 1 << kLevels;  ///< side of the blocks that are shared out

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
      : mesh_(mesh),
        discs_(mesh, std::sqrt(3.0) * (options.band_mm + kBlock * options.spacing_mm)),
        band_(options.band_mm),
        field_(grid_around(mesh, options)),
        inside_(voxels_inside(mesh, field_.geometry())) {}

  Grid<float> run() {
    const auto& size = field_.geometry().size;
    std::array<std::size_t, 3> blocks{};
    for (std::size_t a = 0; a < 3; ++a) {
      blocks[a] = static_cast<std::size_t>((size[a] + kBlock - 1) / kBlock);
    }
    parallel_for(blocks[0] * blocks[1] * blocks[2], 1, [&](std::size_t begin, std::size_t end) {
      Candidates narrowed(kLevels + 1, discs_);
      for (std::size_t b = begin; b < end; ++b) {
        fill_from_all({static_cast<int>(b % blocks[0]) * kBlock,
                       static_cast<int>(b / blocks[0] % blocks[1]) * kBlock,
                       static_cast<int>(b / (blocks[0] * blocks[1])) * kBlock},
                      narrowed);
      }
    });
    return std::move(field_);
  }

 private:
  /// For each level the facets that may be nearest in the block at hand.
  using Candidates = std::vector<FacetDiscs>;

  [[nodiscard]] Vec3 position(double x, double y, double z) const {
    const GridGeometry& g = field_.geometry();
    return {g.origin.x + x * g.spacing.x, g.origin.y + y * g.spacing.y,
            g.origin.z + z * g.spacing.z};
  }

  /// Blocks that are shared out ask all facets.
  void fill_from_all(const VoxelIndex& low, Candidates& narrowed) {
    const double middle = 0.5 * (kBlock - 1);
    const Vec3 centre = position(low.x + middle, low.y + middle, low.z + middle);
    const double reach = std::sqrt(3.0) * middle * field_.geometry().spacing.x;
    FacetDiscs& all = narrowed[kLevels];
    const NearestFacet near = all.nearest(centre, band_ + reach, NearestFacet::kNone);
    if (near.facet == NearestFacet::kNone) return fill(low, kBlock, band_);
    fill_block(low, kLevels, near.facet, narrowed);
  }

  /// A block of 2^level voxels a side, all of whose nearest facets in the band are among
  /// narrowed[level]. `hint` is one that is near.
  void fill_block(const VoxelIndex& low,
                  std::size_t level,
                  std::uint32_t hint,
                  Candidates& narrowed) {
    const int side = 1 << level;
    const double middle = 0.5 * (side - 1);
    const Vec3 centre = position(low.x + middle, low.y + middle, low.z + middle);
    if (level == 0) {
      const NearestFacet near = narrowed[0].nearest(centre, band_, hint);
      return fill(low, 1, std::sqrt(near.squared_distance));
    }
    const double reach = std::sqrt(3.0) * middle * field_.geometry().spacing.x;
    FacetDiscs& kept = narrowed[level - 1];
    const NearestFacet near = nearest_on(mesh_, hint, centre);
    const std::uint32_t middlemost =
        narrowed[level].keep_nearest_in({centre, reach, near}, band_, kept);
    if (kept.size() == 0) return fill(low, side, band_);
    const bool is_nearer =
        nearest_on(mesh_, middlemost, centre).squared_distance < near.squared_distance;
    for (int part = 0; part < 8; ++part) {
      const int step = side / 2;
      const VoxelIndex at{low.x + (part & 1) * step, low.y + (part >> 1 & 1) * step,
                          low.z + (part >> 2) * step};
      if (field_.geometry().contains(at)) {
        fill_block(at, level - 1, is_nearer ? middlemost : hint, narrowed);
      }
    }
  }

  void fill(const VoxelIndex& low, int side, double distance) {
    const auto& size = field_.geometry().size;
    for (int k = low.z; k < std::min(low.z + side, size[2]); ++k) {
      for (int j = low.y; j < std::min(low.y + side, size[1]); ++j) {
        for (int i = low.x; i < std::min(low.x + side, size[0]); ++i) {
          const std::size_t at = field_.geometry().offset_of({i, j, k});
          field_[at] = static_cast<float>(inside_[at] != 0 ? -distance : distance);
        }
      }
    }
  }

  const TriangleMesh& mesh_;
  FacetDiscs discs_;
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
