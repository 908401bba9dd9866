// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/label_by_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "geometry/aabb.hpp"
#include "geometry/voxels_inside.hpp"

namespace carpus::reconstruct {
namespace {

/// Which voxels of a part of the grid a surface holds.
struct Held {
  VoxelIndex low;
  Grid<std::uint8_t> inside;
};

Held held_by(TriangleMesh surface, const GridGeometry& grid) {
  // In voxels, where rows lie along the axes.
  for (Vec3& v : surface.vertices) v = grid.voxel_from_patient(v);
  const Aabb box = bounds_of(surface.vertices);
  GridGeometry part;
  VoxelIndex low;
  std::array<int*, 3> first{&low.x, &low.y, &low.z};
  for (std::size_t a = 0; a < 3; ++a) {
    const int from = std::clamp(static_cast<int>(std::floor(box.low[a])), 0, grid.size[a] - 1);
    const int to = std::clamp(static_cast<int>(std::ceil(box.high[a])), from, grid.size[a] - 1);
    *first[a] = from;
    part.size[a] = to - from + 1;
    part.origin[a] = from;
  }
  return {low, voxels_inside(surface, part)};
}

bool is_held(const Held& held, const VoxelIndex& v) {
  const VoxelIndex n{v.x - held.low.x, v.y - held.low.y, v.z - held.low.z};
  return held.inside.geometry().contains(n) && held.inside[n] != 0;
}

/// Whether a voxel of the whole grid lies beside one that is held.
bool is_beside(const Held& held, const VoxelIndex& v) {
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (is_held(held, {v.x + dx, v.y + dy, v.z + dz})) return true;
      }
    }
  }
  return false;
}

}  // namespace

void label_by_surfaces(const std::vector<const TriangleMesh*>& surfaces,
                       std::span<const std::uint8_t> label_of,
                       const GridView<std::uint8_t>& labels) {
  CARPUS_CHECK(surfaces.size() == label_of.size());
  std::vector<Held> held(surfaces.size());
  parallel_for(surfaces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) held[b] = held_by(*surfaces[b], labels.geometry());
  });
  std::array<std::size_t, 256> bone_of{};
  bone_of.fill(held.size());
  for (std::size_t b = 0; b < held.size(); ++b) bone_of[label_of[b]] = b;
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    if (labels[i] == 0) continue;
    const std::size_t b = bone_of[labels[i]];
    const VoxelIndex v = labels.geometry().index_of(i);
    const bool is_lost = b == held.size() || (!is_held(held[b], v) && is_beside(held[b], v));
    if (is_lost) labels[i] = 0;
  }
  for (std::size_t b = 0; b < held.size(); ++b) {
    const Grid<std::uint8_t>& inside = held[b].inside;
    for (std::size_t i = 0; i < inside.values().size(); ++i) {
      if (inside[i] == 0) continue;
      const VoxelIndex v = inside.geometry().index_of(i);
      const std::size_t at = labels.geometry().offset_of(
          {held[b].low.x + v.x, held[b].low.y + v.y, held[b].low.z + v.z});
      if (labels[at] == 0) labels[at] = label_of[b];
    }
  }
}

}  // namespace carpus::reconstruct
