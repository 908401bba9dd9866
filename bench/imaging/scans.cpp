// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/imaging/scans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/rng.hpp"
#include "imaging/gaussian.hpp"

namespace carpus::bench {
namespace {

constexpr double kSpacingMm = 0.3;
constexpr double kPitchMm = 13;  ///< between bones' middles
constexpr double kCortexMm = 1.2;
constexpr double kSigmaMm = 0.3;  ///< of the gradient
constexpr int kLevels = 4096;
constexpr double kSeedMm = 0.7;  ///< radius of a sparse marker

struct Bone {
  Vec3 middle;
  double radius;
};

std::vector<Bone> place_bones(const GridGeometry& g, Rng& rng) {
  std::vector<Bone> bones;
  const auto count = [&](int axis) {
    return static_cast<int>(g.size[static_cast<std::size_t>(axis)] * kSpacingMm / kPitchMm);
  };
  for (int z = 0; z < count(2); ++z) {
    for (int y = 0; y < count(1); ++y) {
      for (int x = 0; x < count(0); ++x) {
        const auto jitter = [&] { return rng.uniform() - 0.5; };
        const Vec3 middle{(x + 0.5) * kPitchMm + jitter(), (y + 0.5) * kPitchMm + jitter(),
                          (z + 0.5) * kPitchMm + jitter()};
        bones.push_back({middle, 4.3 + 1.2 * rng.uniform()});
      }
    }
  }
  return bones;
}

/// The bone whose surface is nearest, and how deep in it the point lies [mm].
std::pair<std::size_t, double> deepest(const std::vector<Bone>& bones,
                                       const std::array<int, 3>& counts,
                                       const Vec3& p) {
  // Bones stand on a lattice of kPitchMm, moved by at most half a mm: only the cell's own and its
  // neighbours can be nearest.
  std::pair<std::size_t, double> best{0, -std::numeric_limits<double>::infinity()};
  const std::array<int, 3> cell{static_cast<int>(p.x / kPitchMm), static_cast<int>(p.y / kPitchMm),
                                static_cast<int>(p.z / kPitchMm)};
  for (int z = std::max(0, cell[2] - 1); z <= std::min(counts[2] - 1, cell[2] + 1); ++z) {
    for (int y = std::max(0, cell[1] - 1); y <= std::min(counts[1] - 1, cell[1] + 1); ++y) {
      for (int x = std::max(0, cell[0] - 1); x <= std::min(counts[0] - 1, cell[0] + 1); ++x) {
        const auto i = static_cast<std::size_t>((z * counts[1] + y) * counts[0] + x);
        const double depth = bones[i].radius - distance(p, bones[i].middle);
        if (depth > best.second) best = {i, depth};
      }
    }
  }
  return best;
}

std::vector<std::uint16_t> quantised(std::span<const float> relief) {
  const auto [low, high] = std::minmax_element(relief.begin(), relief.end());
  const float scale = *high > *low ? (kLevels - 1) / (*high - *low) : 0.0F;
  std::vector<std::uint16_t> levels;
  levels.reserve(relief.size());
  for (const float v : relief) {
    levels.push_back(static_cast<std::uint16_t>(
        std::min<std::size_t>(kLevels - 1, static_cast<std::size_t>((v - *low) * scale))));
  }
  return levels;
}

}  // namespace

Scan make_scan(const std::array<int, 3>& size, std::uint64_t seed) {
  GridGeometry g;
  g.size = size;
  g.spacing = {kSpacingMm, kSpacingMm, kSpacingMm};
  Rng rng(seed);
  const std::vector<Bone> bones = place_bones(g, rng);
  std::array<int, 3> counts{};
  for (std::size_t a = 0; a < 3; ++a) counts[a] = static_cast<int>(size[a] * kSpacingMm / kPitchMm);
  Scan scan;
  scan.name =
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
  Grid<float> hu(g);
  scan.dense.resize(hu.values().size());
  scan.sparse.resize(hu.values().size());
  const auto outside = static_cast<std::uint16_t>(bones.size() + 1);
  for (std::size_t i = 0; i < hu.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p{v.x * kSpacingMm, v.y * kSpacingMm, v.z * kSpacingMm};
    const auto [bone, depth] = deepest(bones, counts, p);
    hu[i] = depth < 0 ? 45.0F : (depth < kCortexMm ? 1200.0F : 300.0F);
    const auto label = static_cast<std::uint16_t>(bone + 1);
    if (depth > 0.6) scan.dense[i] = label;
    if (depth < -0.3) scan.dense[i] = outside;
    if (distance(p, bones[bone].middle) < kSeedMm) scan.sparse[i] = label;
    if (length(p) < kSeedMm) scan.sparse[i] = outside;
  }
  Grid<float> blurred = imaging::gaussian_smooth(hu.view(), 0.35);
  for (float& value : blurred.values()) value += static_cast<float>(20 * rng.normal());
  const Grid<float> relief = imaging::gradient_magnitude(std::as_const(blurred).view(), kSigmaMm);
  scan.volume.size = size;
  scan.volume.spacing_mm = {kSpacingMm, kSpacingMm, kSpacingMm};
  scan.volume.hu.assign(blurred.values().begin(), blurred.values().end());
  scan.volume.relief.assign(relief.values().begin(), relief.values().end());
  scan.volume.relief_12 = quantised(relief.values());
  return scan;
}

}  // namespace carpus::bench
