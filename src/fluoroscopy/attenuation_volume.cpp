// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Once: mark blocks of 8^3 voxels that hold anything, and their neighbours.
// 2. For a piece of a ray: choose the axis k along which it crosses most voxel planes, clip it to
//    the grid, and visit the planes nearest to it: from its first to its last, rounded.
// 3. March the planes in runs of at most 8; skip a run whose middle lies in an unmarked block.
// 4. A plane stands for half a voxel on either side; the first and the last only for the share of
//    that which the piece covers. So pieces join without a plane counted twice or not at all.
#include "fluoroscopy/attenuation_volume.hpp"

#include <algorithm>
#include <cmath>

#include "fluoroscopy/ct_projector.hpp"

namespace carpus::fluoroscopy {
namespace {

/// Fixed point: 16 bits behind the point for positions, which a run of 8 planes moves off by at
/// most 8 * 2^-17 voxels, and 8 bits for the weights of the four voxels read.
constexpr int kPositionBits = 16;
constexpr int kWeightBits = 8;
constexpr int kWeightShift = kPositionBits - kWeightBits;
constexpr std::int32_t kWeightMask = (1 << kWeightBits) - 1;

/// The part of a piece, 0 at its start and 1 at its end, that lies inside the grid.
struct Part {
  double low = 0.0;
  double high = 1.0;
};

Part inside(const Vec3& from, const Vec3& d, const std::array<int, 3>& size) noexcept {
  Part part;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = size[axis] - 1.0;
    const double to = from[axis] + d[axis];
    if (std::min(from[axis], to) >= 0 && std::max(from[axis], to) <= last) continue;
    if (std::max(from[axis], to) < 0 || std::min(from[axis], to) > last) return {1.0, 0.0};
    if (last < 0) return {1.0, 0.0};
    if (std::abs(d[axis]) < 1e-12) {
      if (!(from[axis] >= 0 && from[axis] <= last)) return {1.0, 0.0};
      continue;
    }
    const double a = (0 - from[axis]) / d[axis];
    const double b = (last - from[axis]) / d[axis];
    part.low = std::max(part.low, std::min(a, b));
    part.high = std::min(part.high, std::max(a, b));
  }
  return part;
}

}  // namespace

std::int16_t attenuation_units(std::int16_t hu) noexcept {
  const double units = attenuation_per_mm(hu) / kAttenuationUnitPerMm;
  return static_cast<std::int16_t>(std::min(32767.0, units + 0.5));
}

AttenuationVolume::AttenuationVolume(const GridView<const std::int16_t>& units)
    : geometry_(units.geometry()) {
  const auto& size = geometry_.size;
  strides_ = {1, size[0] + 2 * kPad,
              static_cast<std::ptrdiff_t>(size[0] + 2 * kPad) * (size[1] + 2 * kPad)};
  values_.assign(
      static_cast<std::size_t>(strides_[2]) * static_cast<std::size_t>(size[2] + 2 * kPad), 0);
  const auto row = static_cast<std::size_t>(size[0]);
  std::size_t from = 0;
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y, from += row) {
      const auto source = units.values().subspan(from, row);
      std::copy(source.begin(), source.end(),
                values_.begin() + static_cast<std::ptrdiff_t>(offset_of({0, y, z})));
    }
  }
  for (std::size_t a = 0; a < 3; ++a) blocks_[a] = (size[a] + kBlock - 1) / kBlock;
  mark_blocks();
}

void AttenuationVolume::mark_blocks() {
  const auto& size = geometry_.size;
  occupied_.assign(static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
                       static_cast<std::size_t>(blocks_[2]),
                   0);
  std::array<int, 3> low = size;
  std::array<int, 3> high{-1, -1, -1};
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      const std::int16_t* const row = values_.data() + offset_of({0, y, z});
      std::uint8_t* const blocks = occupied_.data() + (static_cast<std::size_t>(z / kBlock) *
                                                           static_cast<std::size_t>(blocks_[1]) +
                                                       static_cast<std::size_t>(y / kBlock)) *
                                                          static_cast<std::size_t>(blocks_[0]);
      for (int x = 0; x < size[0]; ++x) {
        if (row[x] == 0) continue;
        blocks[x / kBlock] = 1;
        const std::array<int, 3> v{x, y, z};
        for (std::size_t a = 0; a < 3; ++a) {
          low[a] = std::min(low[a], v[a]);
          high[a] = std::max(high[a], v[a]);
        }
      }
    }
  }
  occupied_box_ = {};
  if (high[0] >= 0) {
    for (std::size_t a = 0; a < 3; ++a) {
      occupied_box_.low[a] = std::max(0, low[a] - 1);
      occupied_box_.high[a] = std::min(size[a], high[a] + 2);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) spread_blocks(axis);
}

void AttenuationVolume::spread_blocks(std::size_t axis) {
  const std::vector<std::uint8_t> before = occupied_;
  const std::array<std::size_t, 3> strides{
      1, static_cast<std::size_t>(blocks_[0]),
      static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1])};
  const std::size_t stride = strides[axis];
  const auto count = static_cast<std::size_t>(blocks_[axis]);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == 0) continue;
    const std::size_t along = i / stride % count;
    if (along > 0) occupied_[i - stride] = 1;
    if (along + 1 < count) occupied_[i + stride] = 1;
  }
}

float AttenuationVolume::mean_between(const Vec3& from_voxel, const Vec3& to_voxel) const noexcept {
  const Vec3 d = to_voxel - from_voxel;
  const Part part = inside(from_voxel, d, geometry_.size);
  if (!(part.low < part.high)) return 0.0F;
  // The steepest axis k and the two others, a and b.
  std::size_t k_axis = std::abs(d.x) > std::abs(d.y) ? 0 : 1;
  if (std::abs(d.z) > std::abs(d[k_axis])) k_axis = 2;
  const std::size_t a_axis = k_axis == 0 ? 1 : 0;
  const std::size_t b_axis = k_axis == 2 ? 1 : 2;
  const double dk = d[k_axis];
  if (!(std::abs(dk) > 0)) return 0.0F;
  double k_low = from_voxel[k_axis] + part.low * dk;
  double k_high = from_voxel[k_axis] + part.high * dk;
  if (dk < 0) std::swap(k_low, k_high);
  k_low = std::max(k_low, 0.0);
  k_high = std::min(k_high, geometry_.size[k_axis] - 1.0);
  const int first = static_cast<int>(k_low + 0.5);
  const int last = static_cast<int>(k_high + 0.5);

  const double da = d[a_axis] / dk;
  const double db = d[b_axis] / dk;
  const double a0 = from_voxel[a_axis] - da * from_voxel[k_axis] + kPad;
  const double b0 = from_voxel[b_axis] - db * from_voxel[k_axis] + kPad;
  const std::ptrdiff_t sk = strides_[k_axis];
  const std::ptrdiff_t sa = strides_[a_axis];
  const std::ptrdiff_t sb = strides_[b_axis];
  const std::int16_t* const values = values_.data() + kPad * sk;
  // Positions and weights in fixed point: a sum of integers is the same in any order and build.
  const auto reading = [&](std::int32_t a, std::int32_t b, std::ptrdiff_t k) noexcept {
    const std::int32_t fa = (a >> kWeightShift) & kWeightMask;
    const std::int32_t fb = (b >> kWeightShift) & kWeightMask;
    const std::int16_t* const p =
        values + k * sk + (a >> kPositionBits) * sa + (b >> kPositionBits) * sb;
    const std::int32_t v00 = p[0];
    const std::int32_t v01 = p[sb];
    const std::int32_t low = (v00 << kWeightBits) + fa * (p[sa] - v00);
    const std::int32_t high = (v01 << kWeightBits) + fa * (p[sa + sb] - v01);
    return (static_cast<std::int64_t>(low) << kWeightBits) +
           static_cast<std::int64_t>(high - low) * fb;
  };
  const auto fixed = [](double value) noexcept {
    return static_cast<std::int32_t>(value * (1 << kPositionBits) + 0.5);
  };
  const auto reading_at = [&](int k) noexcept {
    return reading(fixed(a0 + da * k), fixed(b0 + db * k), k);
  };

  const std::array<std::size_t, 3> block_strides{
      1, static_cast<std::size_t>(blocks_[0]),
      static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1])};
  const auto last_a = static_cast<double>(geometry_.size[a_axis] - 1 + kPad);
  const auto last_b = static_cast<double>(geometry_.size[b_axis] - 1 + kPad);
  const auto step_a = static_cast<std::int32_t>(std::lround(da * (1 << kPositionBits)));
  const auto step_b = static_cast<std::int32_t>(std::lround(db * (1 << kPositionBits)));
  std::int64_t sum = 0;
  for (int run = first; run <= last;) {
    const int run_end = std::min(last, (run / kBlock + 1) * kBlock - 1);
    const double middle = 0.5 * (run + run_end);
    const auto a = static_cast<std::size_t>(
        std::clamp(a0 + da * middle, static_cast<double>(kPad), last_a) - kPad);
    const auto b = static_cast<std::size_t>(
        std::clamp(b0 + db * middle, static_cast<double>(kPad), last_b) - kPad);
    const std::size_t block = static_cast<std::size_t>(run / kBlock) * block_strides[k_axis] +
                              a / kBlock * block_strides[a_axis] +
                              b / kBlock * block_strides[b_axis];
    if (occupied_[block] != 0) {
      std::int32_t at_a = fixed(a0 + da * run);
      std::int32_t at_b = fixed(b0 + db * run);
      for (int k = run; k <= run_end; ++k, at_a += step_a, at_b += step_b) {
        sum += reading(at_a, at_b, k);
      }
    }
    run = run_end + 1;
  }
  // What the outermost planes stand for beyond the piece's ends.
  const double before = k_low - (first - 0.5);
  const double after = last + 0.5 - k_high;
  const double planes = static_cast<double>(sum) - before * static_cast<double>(reading_at(first)) -
                        after * static_cast<double>(reading_at(last));
  constexpr double kUnit = kAttenuationUnitPerMm / (1 << (2 * kWeightBits));
  return static_cast<float>(planes * kUnit / std::abs(dk));
}

double AttenuationVolume::value_at(const Vec3& point_mm) const noexcept {
  const Vec3 v = geometry_.voxel_from_patient(point_mm);
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(v[a] >= 0 && v[a] <= geometry_.size[a] - 1.0)) return 0.0;
  }
  const VoxelIndex low{static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)};
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1;
    const int j = (corner >> 1) & 1;
    const int k = corner >> 2;
    const double weight = (i != 0 ? v.x - low.x : 1 - (v.x - low.x)) *
                          (j != 0 ? v.y - low.y : 1 - (v.y - low.y)) *
                          (k != 0 ? v.z - low.z : 1 - (v.z - low.z));
    sum += weight * units_at({low.x + i, low.y + j, low.z + k});
  }
  return sum * kAttenuationUnitPerMm;
}

}  // namespace carpus::fluoroscopy
