// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Owner of each voxel: the body of its label; within kRimMm of bodies, the nearest one (exact
//    Euclidean distance, cut off at the rim, one axis after the other).
// 2. Soft tissue that would be in a bone's place: means of soft tissue in cells of about 1.2 mm;
//    cells without any take theirs from cells twice, four times, ... as large; read trilinearly.
// 3. A body's voxel is attenuation less that soft tissue; in the rim, what exceeds it, fading out.
// 4. Soft tissue is what remains.
#include "fluoroscopy/tissue_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr std::uint8_t kNobody = 255;
constexpr float kFar = std::numeric_limits<float>::max();
constexpr double kCellMm = 1.2;
/// HU of what counts as soft tissue when it is averaged: neither air nor what a label missed.
constexpr std::int16_t kLeastSoftHu = -200;
constexpr std::int16_t kMostSoftHu = 150;
constexpr std::size_t kRowGrain = 16;

std::array<std::size_t, 3> strides_of(const GridGeometry& g) {
  return {1, static_cast<std::size_t>(g.size[0]),
          static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1])};
}

/// Nearest body of each voxel and the square of the way there [mm2]; kNobody beyond the rim.
struct Owners {
  std::vector<std::uint8_t> body;
  std::vector<float> squared_mm;
};

Owners owners_by_label(const GridView<const std::uint8_t>& labels,
                       std::span<const std::uint8_t> body_labels) {
  std::array<std::uint8_t, 256> body_of{};
  body_of.fill(kNobody);
  for (std::size_t b = 0; b < body_labels.size(); ++b) {
    if (body_of[body_labels[b]] != kNobody || b >= kNobody) {
      throw InvalidInput("fluoroscopy: label " + std::to_string(body_labels[b]) +
                         " is given to two bodies");
    }
    body_of[body_labels[b]] = static_cast<std::uint8_t>(b);
  }
  Owners owners;
  const std::span<const std::uint8_t> values = labels.values();
  owners.body.resize(values.size());
  owners.squared_mm.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    owners.body[i] = body_of[values[i]];
    owners.squared_mm[i] = owners.body[i] == kNobody ? kFar : 0.0F;
  }
  return owners;
}

/// One axis of the distance: each voxel looks along it as far as the rim reaches.
void spread(Owners& owners, const GridGeometry& g, std::size_t axis) {
  const Owners before = owners;
  const std::size_t stride = strides_of(g)[axis];
  const auto count = static_cast<std::size_t>(g.size[axis]);
  const auto reach = static_cast<std::size_t>(kRimMm / g.spacing[axis]);
  constexpr auto kRimSquared = static_cast<float>(kRimMm * kRimMm);
  parallel_for(before.body.size(), 1U << 16U, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (before.squared_mm[i] == 0.0F) continue;
      const std::size_t at = i / stride % count;
      float best = before.squared_mm[i];
      std::uint8_t body = before.body[i];
      const auto look = [&](std::size_t steps, std::size_t from) {
        const double way = static_cast<double>(steps) * g.spacing[axis];
        const float d = before.squared_mm[from] + static_cast<float>(way * way);
        if (d < best && d <= kRimSquared) {
          best = d;
          body = before.body[from];
        }
      };
      for (std::size_t s = 1; s <= std::min(reach, at); ++s) look(s, i - s * stride);
      for (std::size_t s = 1; s <= std::min(reach, count - 1 - at); ++s) look(s, i + s * stride);
      owners.squared_mm[i] = best;
      owners.body[i] = body;
    }
  });
}

/// Sums in cells; `weight` counts what was summed.
struct Cells {
  GridGeometry geometry;
  std::vector<float> sum;
  std::vector<float> weight;

  explicit Cells(const GridGeometry& g)
      : geometry(g), sum(g.voxel_count(), 0.0F), weight(g.voxel_count(), 0.0F) {}
};

GridGeometry coarser(const GridGeometry& fine, const std::array<int, 3>& factor) {
  GridGeometry coarse = fine;
  Vec3 first;
  for (std::size_t a = 0; a < 3; ++a) {
    coarse.size[a] = (fine.size[a] + factor[a] - 1) / factor[a];
    coarse.spacing[a] = fine.spacing[a] * factor[a];
    first[a] = 0.5 * (factor[a] - 1);
  }
  coarse.origin = fine.patient_from_voxel(first);
  return coarse;
}

/// Cells of 2^3 cells.
Cells halved(const Cells& fine) {
  Cells coarse(coarser(fine.geometry, {2, 2, 2}));
  for (std::size_t i = 0; i < fine.sum.size(); ++i) {
    const VoxelIndex v = fine.geometry.index_of(i);
    const std::size_t c = coarse.geometry.offset_of({v.x / 2, v.y / 2, v.z / 2});
    coarse.sum[c] += fine.sum[i];
    coarse.weight[c] += fine.weight[i];
  }
  return coarse;
}

/// Reads a grid between its voxels; beyond its border the nearest voxel counts.
float sample_clamped(const Grid<float>& grid, const Vec3& voxel) {
  const auto& size = grid.geometry().size;
  Vec3 v;
  for (std::size_t a = 0; a < 3; ++a) v[a] = std::clamp(voxel[a], 0.0, size[a] - 1.0);
  return static_cast<float>(sample_trilinear(grid.view(), v, 0.0));
}

/// Means of cells; where a cell holds less than `full`, larger cells make up for the rest.
Grid<float> filled(const Cells& cells, float full) {
  const GridGeometry& g = cells.geometry;
  Grid<float> result(g);
  const bool is_last = g.size[0] <= 1 && g.size[1] <= 1 && g.size[2] <= 1;
  Grid<float> larger;
  if (!is_last) larger = filled(halved(cells), full);
  for (std::size_t i = 0; i < cells.sum.size(); ++i) {
    const float own = cells.weight[i] > 0 ? cells.sum[i] / cells.weight[i] : 0.0F;
    if (is_last || cells.weight[i] >= full) {
      result[i] = own;
      continue;
    }
    const VoxelIndex v = g.index_of(i);
    const Vec3 above{0.5 * v.x - 0.25, 0.5 * v.y - 0.25, 0.5 * v.z - 0.25};
    const float share = cells.weight[i] / full;
    result[i] = share * own + (1.0F - share) * sample_clamped(larger, above);
  }
  return result;
}

/// Soft tissue everywhere, in units, on cells.
Grid<float> soft_tissue_fill(const GridView<const std::int16_t>& ct,
                             const Owners& owners,
                             std::array<int, 3>& factor) {
  const GridGeometry& g = ct.geometry();
  for (std::size_t a = 0; a < 3; ++a) {
    factor[a] = std::max(1, static_cast<int>(std::lround(kCellMm / g.spacing[a])));
  }
  Cells cells(coarser(g, factor));
  std::size_t i = 0;
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      const std::size_t row = cells.geometry.offset_of({0, y / factor[1], z / factor[2]});
      for (int x = 0; x < g.size[0]; ++x, ++i) {
        if (owners.body[i] != kNobody || ct[i] < kLeastSoftHu || ct[i] > kMostSoftHu) continue;
        const std::size_t c = row + static_cast<std::size_t>(x / factor[0]);
        cells.sum[c] += static_cast<float>(attenuation_units(ct[i]));
        cells.weight[c] += 1.0F;
      }
    }
  }
  const auto voxels = static_cast<float>(factor[0] * factor[1] * factor[2]);
  return filled(cells, 0.75F * voxels);
}

/// 1 at the body, 0 at the rim's end, smooth between.
float rim_share(float squared_mm) {
  constexpr auto kCore = static_cast<float>(kRimCoreMm);
  constexpr auto kWidth = static_cast<float>(kRimMm - kRimCoreMm);
  const float t = std::clamp((std::sqrt(squared_mm) - kCore) / kWidth, 0.0F, 1.0F);
  return 1.0F - t * t * (3.0F - 2.0F * t);
}

std::vector<BodyPart> boxes_of(const Owners& owners, const GridGeometry& g, std::size_t bodies) {
  std::vector<BodyPart> parts(bodies);
  for (BodyPart& part : parts) part.box = {g.size, {0, 0, 0}};
  std::size_t i = 0;
  std::array<int, 3> v{};
  for (v[2] = 0; v[2] < g.size[2]; ++v[2]) {
    for (v[1] = 0; v[1] < g.size[1]; ++v[1]) {
      for (v[0] = 0; v[0] < g.size[0]; ++v[0], ++i) {
        if (owners.body[i] == kNobody) continue;
        IndexBox& box = parts[owners.body[i]].box;
        for (std::size_t a = 0; a < 3; ++a) {
          box.low[a] = std::min(box.low[a], v[a]);
          box.high[a] = std::max(box.high[a], v[a] + 1);
        }
      }
    }
  }
  for (BodyPart& part : parts) {
    if (part.box.is_empty()) part.box = {};
    GridGeometry own = g;
    for (std::size_t a = 0; a < 3; ++a) {
      if (!part.box.is_empty()) {  // a voxel of nothing around it, where the scan has room
        part.box.low[a] = std::max(0, part.box.low[a] - 1);
        part.box.high[a] = std::min(g.size[a], part.box.high[a] + 1);
      }
      own.size[a] = part.box.high[a] - part.box.low[a];
    }
    own.origin = g.patient_from_voxel({static_cast<double>(part.box.low[0]),
                                       static_cast<double>(part.box.low[1]),
                                       static_cast<double>(part.box.low[2])});
    part.units = Grid<std::int16_t>(own);
  }
  return parts;
}

}  // namespace

TissueSplit split_tissue(const GridView<const std::int16_t>& ct,
                         const GridView<const std::uint8_t>& labels,
                         std::span<const std::uint8_t> body_labels) {
  const GridGeometry& g = ct.geometry();
  if (labels.geometry().size != g.size) {
    throw InvalidInput("fluoroscopy: the label volume has another size than the CT");
  }
  Owners owners = owners_by_label(labels, body_labels);
  for (std::size_t axis = 0; axis < 3; ++axis) spread(owners, g, axis);

  std::array<int, 3> factor{};
  const Grid<float> fill = soft_tissue_fill(ct, owners, factor);
  TissueSplit split{Grid<std::int16_t>(g), boxes_of(owners, g, body_labels.size())};
  const auto nx = static_cast<std::size_t>(g.size[0]);
  const auto rows = static_cast<std::size_t>(g.size[1]) * static_cast<std::size_t>(g.size[2]);
  parallel_for(rows, kRowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const auto y = static_cast<int>(row) % g.size[1];
      const auto z = static_cast<int>(row) / g.size[1];
      for (std::size_t i = row * nx; i < (row + 1) * nx; ++i) {
        const std::int16_t all = attenuation_units(ct[i]);
        split.soft[i] = all;
        if (owners.body[i] == kNobody) continue;
        const auto x = static_cast<int>(i - row * nx);
        const auto in_cells = [&](int v, std::size_t axis) {
          return (v + 0.5) / factor[axis] - 0.5;
        };
        const float soft = sample_clamped(fill, {in_cells(x, 0), in_cells(y, 1), in_cells(z, 2)});
        float above = static_cast<float>(all) - soft;
        if (owners.squared_mm[i] > 0) {
          above = std::max(above, 0.0F) * rim_share(owners.squared_mm[i]);
        }
        const auto units = static_cast<std::int16_t>(std::lround(above));
        BodyPart& part = split.bodies[owners.body[i]];
        part.units[VoxelIndex{x - part.box.low[0], y - part.box.low[1], z - part.box.low[2]}] =
            units;
        split.soft[i] = static_cast<std::int16_t>(all - units);
      }
    }
  });
  return split;
}

}  // namespace carpus::fluoroscopy
