// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/mend_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/edge_excess.hpp"
#include "imaging/gaussian.hpp"
#include "reconstruct/ground_truth.hpp"
#include "reconstruct/grow_paint.hpp"

namespace carpus::reconstruct {
namespace {

/// Around the bones: where a surface's field and the gradient reach.
constexpr double kMarginMm = 4;

struct Touched {
  std::array<bool, 256> labels{};
  bool any = false;
};

Touched touched_by(const Grid<std::uint8_t>& before, const Grid<std::uint8_t>& painted) {
  Touched touched;
  for (std::size_t i = 0; i < before.values().size(); ++i) {
    if (before[i] == painted[i]) continue;
    touched.any = true;
    touched.labels[before[i]] = touched.labels[painted[i]] = true;
  }
  touched.labels[kBackgroundLabel] = false;
  return touched;
}

imaging::VoxelBox box_of(const Grid<std::uint8_t>& before,
                         const Grid<std::uint8_t>& painted,
                         const Touched& touched) {
  const GridGeometry& g = before.geometry();
  VoxelIndex low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                 std::numeric_limits<int>::max()};
  VoxelIndex high{-1, -1, -1};
  std::size_t i = 0;
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = 0; x < g.size[0]; ++x, ++i) {
        if (!touched.labels[before[i]] && !touched.labels[painted[i]]) continue;
        low = {std::min(low.x, x), std::min(low.y, y), std::min(low.z, z)};
        high = {std::max(high.x, x), std::max(high.y, y), std::max(high.z, z)};
      }
    }
  }
  const auto reach = [](double spacing) {
    return static_cast<int>(std::ceil(kMarginMm / spacing));
  };
  const VoxelIndex by{reach(g.spacing.x), reach(g.spacing.y), reach(g.spacing.z)};
  return {{std::max(0, low.x - by.x), std::max(0, low.y - by.y), std::max(0, low.z - by.z)},
          {std::min(g.size[0] - 1, high.x + by.x), std::min(g.size[1] - 1, high.y + by.y),
           std::min(g.size[2] - 1, high.z + by.z)}};
}

void put_back(const Grid<std::uint8_t>& part, const VoxelIndex& low, Grid<std::uint8_t>& whole) {
  std::size_t i = 0;
  const auto& size = part.geometry().size;
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x, ++i) {
        whole[VoxelIndex{low.x + x, low.y + y, low.z + z}] = part[i];
      }
    }
  }
}

std::vector<MendedBone> surfaces_of(const Grid<std::uint8_t>& part,
                                    const Grid<float>& smoothed,
                                    const Touched& touched,
                                    const MendOptions& options) {
  const float soft_tissue = imaging::median_soft_tissue(smoothed.view(), part.view());
  const Grid<float> excess =
      imaging::measure_edge_excess(smoothed.view(), part.view(), soft_tissue, options.segmentation);
  std::array<std::size_t, 256> voxels{};
  for (const std::uint8_t label : part.values()) ++voxels[label];
  std::vector<MendedBone> bones;
  for (std::size_t label = 1; label < touched.labels.size(); ++label) {
    if (!touched.labels[label]) continue;
    bones.push_back({static_cast<std::uint8_t>(label),
                     static_cast<double>(voxels[label]) * part.geometry().voxel_volume_mm3(),
                     {}});
  }
  parallel_for(bones.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      bones[k].surface = build_bone_surface(
          build_bone_field(part.view(), bones[k].label, excess.view(), options.surface),
          options.surface);
    }
  });
  return bones;
}

}  // namespace

Mended mend_bones(const GridView<const std::int16_t>& ct,
                  const Grid<std::uint8_t>& before,
                  const Grid<std::uint8_t>& painted,
                  const MendOptions& options) {
  require_same_grid(ct.geometry(), before.geometry(), "the label volume before");
  require_same_grid(ct.geometry(), painted.geometry(), "the painted label volume");
  const Touched touched = touched_by(before, painted);
  if (!touched.any) throw InvalidInput("nothing was painted: the labels are the same");
  const imaging::VoxelBox box = box_of(before, painted, touched);
  const Grid<std::int16_t> hu = imaging::crop(ct, box);
  const Grid<float> smoothed =
      imaging::gaussian_smooth(hu.view(), options.segmentation.smoothing_sigma_mm);
  Grid<std::uint8_t> part = imaging::crop(painted.view(), box);
  Mended mended;
  mended.labels = painted;
  if (options.grows) {
    part = grow_paint(hu, smoothed, imaging::crop(before.view(), box), part, options.segmentation);
    put_back(part, box.low, mended.labels);
  }
  mended.bones = surfaces_of(part, smoothed, touched, options);
  return mended;
}

}  // namespace carpus::reconstruct
