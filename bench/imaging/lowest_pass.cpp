// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/imaging/lowest_pass.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace carpus::bench {
namespace {

constexpr std::uint16_t kUnreached = std::numeric_limits<std::uint16_t>::max();
constexpr std::size_t kLevels = 4096;

/// For each voxel the lowest level that a way from a marker has to rise to; only over steps that
/// `may_step(from, to)` allows. One bucket a level.
template <typename MayStep>
std::vector<std::uint16_t> pass_levels(const std::array<int, 3>& size,
                                       std::span<const std::uint16_t> levels,
                                       std::span<const std::uint16_t> markers,
                                       const MayStep& may_step) {
  std::vector<std::uint16_t> pass(levels.size(), kUnreached);
  std::vector<std::vector<std::uint32_t>> buckets(kLevels);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (markers[i] == 0) continue;
    pass[i] = 0;
    buckets[0].push_back(static_cast<std::uint32_t>(i));
  }
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(size[0]),
      static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  for (std::size_t level = 0; level < kLevels; ++level) {
    std::vector<std::uint32_t>& bucket = buckets[level];
    while (!bucket.empty()) {
      const std::uint32_t i = bucket.back();
      bucket.pop_back();
      std::size_t rest = i;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto n = static_cast<std::size_t>(size[axis]);
        const std::size_t at = rest % n;
        rest /= n;
        const auto go_to = [&](std::size_t j) {
          if (pass[j] != kUnreached || !may_step(i, j)) return;
          pass[j] = std::max(levels[j], static_cast<std::uint16_t>(level));
          buckets[pass[j]].push_back(static_cast<std::uint32_t>(j));
        };
        if (at > 0) go_to(i - stride[axis]);
        if (at + 1 < n) go_to(i + stride[axis]);
      }
    }
    std::vector<std::uint32_t>().swap(bucket);
  }
  return pass;
}

}  // namespace

BasinCheck check_basins(const std::array<int, 3>& size,
                        std::span<const std::uint16_t> levels,
                        std::span<const std::uint16_t> markers,
                        std::span<const std::uint16_t> labels,
                        std::span<const std::uint16_t> reference) {
  const auto lowest =
      pass_levels(size, levels, markers, [](std::size_t, std::size_t) { return true; });
  const auto own = pass_levels(size, levels, markers, [&](std::size_t from, std::size_t to) {
    return labels[from] == labels[to];
  });
  BasinCheck check;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool kept = markers[i] == 0 || labels[i] == markers[i];
    if (labels[i] == 0 || !kept || own[i] != lowest[i]) ++check.wrong;
    if (labels[i] != reference[i]) ++check.other;
  }
  return check;
}

}  // namespace carpus::bench
