// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Once: mark blocks of 8^3 voxels that hold more than air, and their neighbours.
// 2. For a ray: choose the axis k along which it crosses most voxel planes; write the two other
//    coordinates as linear functions of k; clip k to where all three are inside the grid.
// 3. March the planes in runs of 8; skip a run whose middle lies in an unmarked block: within the
//    run the ray moves at most 4 voxels from the middle and reads one further, so it stays in the
//    marked block's neighbourhood.
// 4. Sum attenuation of the bilinear HU; multiply by the length between planes at the end.
#include "fluoroscopy/ct_projector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carpus::fluoroscopy {
namespace {

struct Range {
  double low;
  double high;
};

/// Narrows `range` of k to where offset + slope * k lies in [0, last].
void clip(Range& range, double offset, double slope, double last) noexcept {
  if (std::abs(slope) < 1e-12) {
    if (!(offset >= 0 && offset <= last)) range = {1, 0};
    return;
  }
  const double a = (0 - offset) / slope;
  const double b = (last - offset) / slope;
  range.low = std::max(range.low, std::min(a, b));
  range.high = std::min(range.high, std::max(a, b));
}

}  // namespace

CtProjector::CtProjector(const GridView<const std::int16_t>& ct) : ct_(ct) { mark_blocks(); }

void CtProjector::mark_blocks() {
  const auto& size = ct_.geometry().size;
  for (std::size_t a = 0; a < 3; ++a) blocks_[a] = (size[a] + kBlock - 1) / kBlock;
  occupied_.assign(static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
                       static_cast<std::size_t>(blocks_[2]),
                   0);
  std::size_t offset = 0;
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x, ++offset) {
        if (ct_[offset] > kAirHu) occupied_[block_of({x, y, z})] = 1;
      }
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) spread_blocks(axis);
}

void CtProjector::spread_blocks(std::size_t axis) {
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

std::size_t CtProjector::block_of(const std::array<int, 3>& voxel) const noexcept {
  const auto block = [&](std::size_t axis) {
    return static_cast<std::size_t>(voxel[axis] / kBlock);
  };
  return (block(2) * static_cast<std::size_t>(blocks_[1]) + block(1)) *
             static_cast<std::size_t>(blocks_[0]) +
         block(0);
}

float CtProjector::line_integral(const Vec3& from_voxel, const Vec3& to_voxel) const noexcept {
  const GridGeometry& geometry = ct_.geometry();
  const Vec3 d = to_voxel - from_voxel;
  // The steepest axis k and the two others, a and b.
  std::size_t k_axis = std::abs(d.x) > std::abs(d.y) ? 0 : 1;
  if (std::abs(d.z) > std::abs(d[k_axis])) k_axis = 2;
  const std::size_t a_axis = k_axis == 0 ? 1 : 0;
  const std::size_t b_axis = k_axis == 2 ? 1 : 2;
  const auto& size = geometry.size;
  if (size[a_axis] < 2 || size[b_axis] < 2 || !(std::abs(d[k_axis]) > 0)) return 0.0F;

  const double da = d[a_axis] / d[k_axis];
  const double db = d[b_axis] / d[k_axis];
  const double a0 = from_voxel[a_axis] - da * from_voxel[k_axis];
  const double b0 = from_voxel[b_axis] - db * from_voxel[k_axis];
  Range range{std::max(0.0, std::min(from_voxel[k_axis], to_voxel[k_axis])),
              std::min(size[k_axis] - 1.0, std::max(from_voxel[k_axis], to_voxel[k_axis]))};
  clip(range, a0, da, size[a_axis] - 1.0);
  clip(range, b0, db, size[b_axis] - 1.0);
  if (!(range.low <= range.high)) return 0.0F;
  const int first = static_cast<int>(std::ceil(range.low));
  const int last = static_cast<int>(std::floor(range.high));

  const std::array<std::ptrdiff_t, 3> strides{
      1, size[0], static_cast<std::ptrdiff_t>(size[0]) * static_cast<std::ptrdiff_t>(size[1])};
  const std::ptrdiff_t sk = strides[k_axis];
  const std::ptrdiff_t sa = strides[a_axis];
  const std::ptrdiff_t sb = strides[b_axis];
  const int a_last = size[a_axis] - 2;
  const int b_last = size[b_axis] - 2;
  const std::int16_t* const values = ct_.values().data();
  constexpr auto kAir = static_cast<float>(-kAirHu);

  float above_air = 0.0F;  // sum of max(HU - air, 0)
  float above_water = 0.0F;
  for (int run = first; run <= last;) {
    const int run_end = std::min(last, (run / kBlock + 1) * kBlock - 1);
    const double middle = 0.5 * (run + run_end);
    std::array<int, 3> voxel{};
    voxel[k_axis] = run;
    voxel[a_axis] = std::clamp(static_cast<int>(a0 + da * middle), 0, size[a_axis] - 1);
    voxel[b_axis] = std::clamp(static_cast<int>(b0 + db * middle), 0, size[b_axis] - 1);
    if (occupied_[block_of(voxel)] != 0) {
      for (int k = run; k <= run_end; ++k) {
        const auto a = static_cast<float>(a0 + da * k);
        const auto b = static_cast<float>(b0 + db * k);
        const int ia = std::clamp(static_cast<int>(a), 0, a_last);
        const int ib = std::clamp(static_cast<int>(b), 0, b_last);
        const float fa = a - static_cast<float>(ia);
        const float fb = b - static_cast<float>(ib);
        const std::int16_t* const p = values + k * sk + ia * sa + ib * sb;
        const auto v00 = static_cast<float>(p[0]);
        const auto v01 = static_cast<float>(p[sb]);
        const float low = v00 + fa * (static_cast<float>(p[sa]) - v00);
        const float high = v01 + fa * (static_cast<float>(p[sa + sb]) - v01);
        const float hu = low + fb * (high - low);
        above_air += std::max(hu + kAir, 0.0F);
        above_water += std::max(hu, 0.0F);
      }
    }
    run = run_end + 1;
  }
  const Vec3 step{d.x / d[k_axis] * geometry.spacing.x, d.y / d[k_axis] * geometry.spacing.y,
                  d.z / d[k_axis] * geometry.spacing.z};
  constexpr double kSoftSlope = kWaterPerMm / -kAirHu;
  constexpr double kExtraSlope = (kCorticalPerMm - kWaterPerMm) / kCorticalHu - kSoftSlope;
  return static_cast<float>(length(step) * (kSoftSlope * static_cast<double>(above_air) +
                                            kExtraSlope * static_cast<double>(above_water)));
}

}  // namespace carpus::fluoroscopy
