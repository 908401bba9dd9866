// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/peak_markers.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace carpus::imaging {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Voxels grouped by the peak they lead up to; a root is the peak itself.
class PeakForest {
 public:
  PeakForest(const MaskedValues& height, const PeakOptions& options)
      : height_(height), options_(options), parent_(height.mask().count(), kNone) {}

  [[nodiscard]] bool is_raised(std::size_t i) const {
    return height_.mask().contains(i) && parent(i) != kNone;
  }

  std::uint32_t root(std::uint32_t i) {
    for (std::uint32_t up = parent(i); up != i; up = parent(i)) {
      i = parent(i) = parent(up);
    }
    return i;
  }

  void raise(std::uint32_t i) { parent(i) = i; }

  /// Joins the groups of voxels i and j, which meet at `saddle`; the lower peak ends there, and is
  /// kept if it was prominent.
  void meet(std::uint32_t i, std::uint32_t j, float saddle) {
    const std::uint32_t a = root(i);
    const std::uint32_t b = root(j);
    if (a == b) return;
    const float height_a = height_[a];
    const float height_b = height_[b];
    const bool a_wins = height_a != height_b ? height_a > height_b : a < b;
    const std::uint32_t winner = a_wins ? a : b;
    const std::uint32_t loser = a_wins ? b : a;
    const double prominence =
        static_cast<double>(std::min(height_a, height_b)) - static_cast<double>(saddle);
    if (prominence > 0 && prominence >= options_.min_prominence) keep(loser);
    parent(loser) = winner;
  }

  void keep(std::uint32_t peak) {
    if (static_cast<double>(height_[peak]) >= options_.min_height) peaks_.push_back(peak);
  }

  [[nodiscard]] std::vector<std::size_t> take_peaks() {
    std::sort(peaks_.begin(), peaks_.end(), [&](std::size_t a, std::size_t b) {
      return height_[a] != height_[b] ? height_[a] > height_[b] : a < b;
    });
    return std::move(peaks_);
  }

 private:
  [[nodiscard]] std::uint32_t& parent(std::size_t i) {
    return parent_[height_.mask().number_of(i)];
  }
  [[nodiscard]] std::uint32_t parent(std::size_t i) const {
    return parent_[height_.mask().number_of(i)];
  }

  const MaskedValues& height_;
  PeakOptions options_;
  std::vector<std::uint32_t> parent_;  ///< [number in the mask] a voxel
  std::vector<std::size_t> peaks_;
};

/// The higher, the lower this number; the bits of equal numbers may differ below it.
std::size_t bucket_of(float height) {
  constexpr unsigned kDropped = 12;
  const auto bits = std::bit_cast<std::uint32_t>(height + 0.0F);  // no -0
  constexpr std::uint32_t kSign = 1U << 31U;
  // Bits of floats run upwards where they are positive, downwards where they are negative.
  const std::uint32_t descending = (bits & kSign) != 0 ? bits : ~bits & ~kSign;
  return descending >> kDropped;
}
constexpr std::size_t kBuckets = std::size_t{1} << 20U;

/// The mask's voxels from high to low, ties in the order of memory: counted into buckets first, so
/// that what has to be sorted is short, and mostly is sorted.
std::vector<std::uint32_t> from_high_to_low(const MaskedValues& height) {
  std::vector<std::uint32_t> begin(kBuckets + 1, 0);
  height.for_each([&](std::size_t, float value) { ++begin[bucket_of(value) + 1]; });
  for (std::size_t b = 0; b < kBuckets; ++b) begin[b + 1] += begin[b];
  std::vector<std::uint32_t> order(height.mask().count());
  height.for_each([&](std::size_t i, float value) {
    order[begin[bucket_of(value)]++] = static_cast<std::uint32_t>(i);
  });
  // Each bucket now begins where the one before it ends, which is what `begin` has come to.
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
    const float height_a = height[a];
    const float height_b = height[b];
    return height_a != height_b ? height_a > height_b : a < b;
  };
  std::uint32_t first = 0;
  for (std::size_t b = 0; b < kBuckets; ++b) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = order.begin() + static_cast<std::ptrdiff_t>(begin[b]);
    if (!std::is_sorted(from, to, is_before)) std::sort(from, to, is_before);
    first = begin[b];
  }
  return order;
}

}  // namespace

std::vector<std::size_t> prominent_peaks(const MaskedValues& height, const PeakOptions& options) {
  const GridGeometry& g = height.geometry();
  CARPUS_CHECK(g.voxel_count() < kNone);
  const std::vector<std::uint32_t> order = from_high_to_low(height);
  PeakForest forest(height, options);
  const auto dy = static_cast<std::size_t>(g.size[0]);
  const std::size_t dz = dy * static_cast<std::size_t>(g.size[1]);
  for (const std::uint32_t i : order) {
    forest.raise(i);
    const VoxelIndex v = g.index_of(i);
    const float here = height[i];
    const auto meet = [&](bool inside, std::size_t j) {
      if (inside && forest.is_raised(j)) forest.meet(i, static_cast<std::uint32_t>(j), here);
    };
    meet(v.x > 0, i - 1);
    meet(v.x + 1 < g.size[0], i + 1);
    meet(v.y > 0, i - dy);
    meet(v.y + 1 < g.size[1], i + dy);
    meet(v.z > 0, i - dz);
    meet(v.z + 1 < g.size[2], i + dz);
  }
  for (const std::uint32_t i : order) {
    if (forest.root(i) == i) forest.keep(i);
  }
  return forest.take_peaks();
}

std::vector<std::size_t> prominent_peaks(const GridView<const float>& height,
                                         const GridView<const std::uint8_t>& mask,
                                         const PeakOptions& options) {
  return prominent_peaks(MaskedValues(height, mask), options);
}

}  // namespace carpus::imaging
