// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/peak_markers.hpp"

#include <algorithm>
#include <limits>

namespace carpus::imaging {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Voxels grouped by the peak they lead up to; a root is the peak itself.
class PeakForest {
 public:
  PeakForest(const GridView<const float>& height, const PeakOptions& options)
      : height_(height), options_(options), parent_(height.values().size(), kNone) {}

  [[nodiscard]] bool is_raised(std::size_t i) const { return parent_[i] != kNone; }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void raise(std::size_t i) { parent_[i] = static_cast<std::uint32_t>(i); }

  /// Joins the groups of voxels i and j, which meet at `saddle`; the lower peak ends there, and is
  /// kept if it was prominent.
  void meet(std::uint32_t i, std::uint32_t j, float saddle) {
    const std::uint32_t a = root(i);
    const std::uint32_t b = root(j);
    if (a == b) return;
    const bool a_wins = height_[a] != height_[b] ? height_[a] > height_[b] : a < b;
    const std::uint32_t winner = a_wins ? a : b;
    const std::uint32_t loser = a_wins ? b : a;
    const double prominence = static_cast<double>(height_[loser]) - static_cast<double>(saddle);
    if (prominence > 0 && prominence >= options_.min_prominence) keep(loser);
    parent_[loser] = winner;
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
  GridView<const float> height_;
  PeakOptions options_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::size_t> peaks_;
};

}  // namespace

std::vector<std::size_t> prominent_peaks(const GridView<const float>& height,
                                         const GridView<const std::uint8_t>& mask,
                                         const PeakOptions& options) {
  const GridGeometry& g = height.geometry();
  CARPUS_CHECK(mask.values().size() == height.values().size());
  CARPUS_CHECK(height.values().size() < kNone);
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    if (mask[i] != 0) order.push_back(static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return height[a] != height[b] ? height[a] > height[b] : a < b;
  });
  PeakForest forest(height, options);
  const auto dy = static_cast<std::size_t>(g.size[0]);
  const std::size_t dz = dy * static_cast<std::size_t>(g.size[1]);
  for (const std::uint32_t i : order) {
    forest.raise(i);
    const VoxelIndex v = g.index_of(i);
    const auto meet = [&](bool inside, std::size_t j) {
      if (inside && forest.is_raised(j)) forest.meet(i, static_cast<std::uint32_t>(j), height[i]);
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

}  // namespace carpus::imaging
