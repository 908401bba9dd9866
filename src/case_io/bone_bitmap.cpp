// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/bone_bitmap.hpp"

#include <algorithm>
#include <cmath>

#include "case_io/png.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::case_io {
namespace {

/// Under the surface, within the cortex where there is one [mm].
constexpr double kDepthMm = 0.8;
/// Porous to dense [HU].
constexpr double kPorousHu = 150;
constexpr double kDenseHu = 1100;
constexpr double kDensityShare = 0.55;

/// 0 to 1 for the corners of a lattice (a hash of integers by multiplications and shifts).
double at_corner(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U ^
           static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU ^
           static_cast<std::uint64_t>(z) * 0x165667B19E3779F9U;
  h = (h ^ h >> 29U) * 0xBF58476D1CE4E5B9U;
  h = (h ^ h >> 32U) * 0x94D049BB133111EBU;
  return static_cast<double>(h >> 40U) / static_cast<double>(1U << 24U);
}

/// Value noise: smooth between the corners of a lattice of 1.
double noise(const Vec3& p) {
  std::array<std::int64_t, 3> low{};
  std::array<double, 3> f{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double floor = std::floor(p[i]);
    low[i] = static_cast<std::int64_t>(floor);
    const double t = p[i] - floor;
    f[i] = t * t * (3 - 2 * t);
  }
  double sum = 0;
  for (std::int64_t c = 0; c < 8; ++c) {
    const std::int64_t dx = c & 1;
    const std::int64_t dy = c >> 1 & 1;
    const std::int64_t dz = c >> 2 & 1;
    sum += (dx != 0 ? f[0] : 1 - f[0]) * (dy != 0 ? f[1] : 1 - f[1]) * (dz != 0 ? f[2] : 1 - f[2]) *
           at_corner(low[0] + dx, low[1] + dy, low[2] + dz);
  }
  return sum;
}

double grain(const Vec3& p) {
  return 0.5 * noise(p * 0.45) + 0.32 * noise(p * 1.7) + 0.18 * noise(p * 5.0);
}

constexpr std::array<double, 3> kPorous{0.70, 0.52, 0.42};
constexpr std::array<double, 3> kDense{1.0, 0.99, 0.96};

}  // namespace

std::span<const std::array<std::uint8_t, 3>> BoneBitmap::palette() {
  static const auto kPalette = [] {
    std::array<std::array<std::uint8_t, 3>, 256> palette{};
    for (std::size_t i = 0; i < palette.size(); ++i) {
      const double t = static_cast<double>(i) / 255;
      for (std::size_t c = 0; c < 3; ++c) {
        palette[i][c] =
            static_cast<std::uint8_t>(std::lround(255 * ((1 - t) * kPorous[c] + t * kDense[c])));
      }
    }
    return palette;
  }();
  return kPalette;
}

std::string BoneBitmap::png() const {
  return png_of_indexed(atlas.side, atlas.side, palette(), texels);
}

BoneBitmap make_bone_bitmap(const cases::Bone& bone,
                            const GridView<const std::int16_t>& ct,
                            int side) {
  BoneBitmap bitmap{mesh::make_texture_atlas(bone.surface, side), {}};
  const bool has_ct = ct.geometry().voxel_count() > 0;
  bitmap.texels =
      mesh::paint_texture(bitmap.atlas, bone.surface, [&](const Vec3& point, const Vec3& normal) {
        const Vec3 under = point - normal * kDepthMm;  // Bone is Patient as scanned
        const double hu = has_ct ? sample_at(ct, under, kDenseHu) : kDenseHu;
        const double density = std::clamp((hu - kPorousHu) / (kDenseHu - kPorousHu), 0.0, 1.0);
        const double t = kDensityShare * density + (1 - kDensityShare) * grain(point);
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(t, 0.0, 1.0)));
      });
  return bitmap;
}

}  // namespace carpus::case_io
