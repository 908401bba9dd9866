// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/region_merging.hpp"

#include <algorithm>
#include <limits>

#include "imaging/detail/run_components.hpp"

namespace carpus::imaging {
namespace {

using Pair = std::pair<RegionLabel, RegionLabel>;

Pair ordered(RegionLabel a, RegionLabel b) { return {std::min(a, b), std::max(a, b)}; }

/// Regions that join and vanish; remembers into which region each label went.
class Merger {
 public:
  explicit Merger(RegionTable table) : table_(std::move(table)), into_(table_.voxels.size()) {
    for (std::size_t i = 0; i < into_.size(); ++i) into_[i] = static_cast<RegionLabel>(i);
  }

  /// Two regions; {0, 0} where no neck is as wide as the limit.
  [[nodiscard]] Pair widest_neck(double limit) const {
    Pair best{0, 0};
    double best_ratio = limit;
    for (const auto& [pair, contact] : table_.contacts) {
      const float peak = std::min(table_.peak[pair.first], table_.peak[pair.second]);
      const double ratio = peak > 0 ? static_cast<double>(contact.saddle / peak) : 0.0;
      if (ratio > best_ratio || (best.first == 0 && ratio >= limit)) {
        best = pair;
        best_ratio = ratio;
      }
    }
    return best;
  }

  [[nodiscard]] RegionLabel smallest_below(double voxels) const {
    RegionLabel best = 0;
    for (std::size_t i = 1; i < table_.voxels.size(); ++i) {
      const std::size_t n = table_.voxels[i];
      if (n == 0 || static_cast<double>(n) >= voxels) continue;
      if (best == 0 || n < table_.voxels[best]) best = static_cast<RegionLabel>(i);
    }
    return best;
  }

  [[nodiscard]] RegionLabel most_touched_by(RegionLabel region) const {
    RegionLabel best = 0;
    double best_area = 0;
    for (const auto& [pair, contact] : table_.contacts) {
      if (pair.first != region && pair.second != region) continue;
      if (contact.area_mm2 > best_area) {
        best_area = contact.area_mm2;
        best = pair.first == region ? pair.second : pair.first;
      }
    }
    return best;
  }

  /// Joins `from` into `to`; `to` = 0 drops it.
  void join(RegionLabel to, RegionLabel from) {
    for (RegionLabel& label : into_) {
      if (label == from) label = to;
    }
    std::map<Pair, Contact> contacts;
    for (const auto& [pair, contact] : table_.contacts) {
      const RegionLabel a = pair.first == from ? to : pair.first;
      const RegionLabel b = pair.second == from ? to : pair.second;
      if (a == b || a == 0 || b == 0) continue;
      Contact& joined = contacts[ordered(a, b)];
      joined.area_mm2 += contact.area_mm2;
      joined.saddle = std::max(joined.saddle, contact.saddle);
    }
    table_.contacts = std::move(contacts);
    if (to != 0) {
      table_.voxels[to] += table_.voxels[from];
      table_.peak[to] = std::max(table_.peak[to], table_.peak[from]);
    }
    table_.voxels[from] = 0;
  }

  /// Labels without holes.
  [[nodiscard]] std::vector<RegionLabel> renumbered() const {
    std::vector<RegionLabel> number(into_.size(), 0);
    RegionLabel next = 0;
    for (std::size_t i = 1; i < into_.size(); ++i) {
      if (table_.voxels[i] > 0 && into_[i] == i) number[i] = ++next;
    }
    std::vector<RegionLabel> result(into_.size(), 0);
    for (std::size_t i = 1; i < into_.size(); ++i) result[i] = number[into_[i]];
    return result;
  }

 private:
  RegionTable table_;
  std::vector<RegionLabel> into_;
};

}  // namespace

namespace {

/// @param height  called with a voxel of a region.
template <typename Height>
RegionTable measured(const GridView<const RegionLabel>& labels, const Height& height) {
  const GridGeometry& g = labels.geometry();
  RegionLabel count = 0;
  for (const RegionLabel label : labels.values()) count = std::max(count, label);
  RegionTable table;
  table.voxels.assign(count + std::size_t{1}, 0);
  table.peak.assign(count + std::size_t{1}, -std::numeric_limits<float>::infinity());
  const auto dy = static_cast<std::size_t>(g.size[0]);
  const std::size_t dz = dy * static_cast<std::size_t>(g.size[1]);
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const RegionLabel a = labels[i];
    if (a == 0) continue;
    ++table.voxels[a];
    table.peak[a] = std::max(table.peak[a], height(i));
    const VoxelIndex v = g.index_of(i);
    const auto touch = [&](bool inside, std::size_t j, double face_mm2) {
      if (!inside || labels[j] == 0 || labels[j] == a) return;
      const float saddle = std::min(height(i), height(j));
      const auto [contact, is_new] = table.contacts.try_emplace(ordered(a, labels[j]));
      contact->second.area_mm2 += face_mm2;
      contact->second.saddle = is_new ? saddle : std::max(contact->second.saddle, saddle);
    };
    touch(v.x + 1 < g.size[0], i + 1, g.spacing.y * g.spacing.z);
    touch(v.y + 1 < g.size[1], i + dy, g.spacing.x * g.spacing.z);
    touch(v.z + 1 < g.size[2], i + dz, g.spacing.x * g.spacing.y);
  }
  return table;
}

}  // namespace

RegionTable measure_regions(const GridView<const RegionLabel>& labels,
                            const GridView<const float>& height) {
  return measured(labels, [&](std::size_t i) { return height[i]; });
}

RegionTable measure_regions(const GridView<const RegionLabel>& labels, const MaskedValues& height) {
  return measured(labels, [&](std::size_t i) { return height[i]; });
}

std::vector<RegionLabel> merge_regions(RegionTable table,
                                       double voxel_volume_mm3,
                                       const MergeOptions& options) {
  Merger merger(std::move(table));
  while (true) {
    const auto [to, from] = merger.widest_neck(options.neck_ratio);
    if (to == 0) break;
    merger.join(to, from);
  }
  const double min_voxels = options.min_volume_mm3 / voxel_volume_mm3;
  while (const RegionLabel small = merger.smallest_below(min_voxels)) {
    merger.join(merger.most_touched_by(small), small);
  }
  return merger.renumbered();
}

void relabel(const GridView<RegionLabel>& labels, const std::vector<RegionLabel>& labels_to) {
  for (RegionLabel& label : labels.values()) label = labels_to[label];
}

std::size_t keep_largest_components(const GridView<RegionLabel>& labels) {
  RegionLabel count = 0;
  return part_components(labels, std::numeric_limits<std::size_t>::max(), count);
}

std::size_t part_components(const GridView<RegionLabel>& labels,
                            std::size_t least_voxels,
                            RegionLabel& count) {
  const detail::RunComponents runs{GridView<const RegionLabel>(labels)};
  const std::vector<std::size_t>& size_of = runs.voxels();
  std::vector<std::uint32_t> best_of;  // [region] its largest component, the first of equals
  std::vector<char> is_counted(size_of.size(), 0);
  runs.for_each([&](std::size_t first, std::size_t, std::uint32_t piece) {
    if (std::exchange(is_counted[piece], 1) != 0) return;
    const RegionLabel label = labels[first];
    if (best_of.size() <= label) best_of.resize(label + std::size_t{1}, 0);
    if (size_of[piece] > size_of[best_of[label]]) best_of[label] = piece;
  });
  std::vector<RegionLabel> own_label(size_of.size(), 0);
  std::size_t removed = 0;
  runs.for_each([&](std::size_t first, std::size_t end, std::uint32_t piece) {
    if (piece == best_of[labels[first]]) return;
    const bool is_kept = size_of[piece] >= least_voxels;
    if (is_kept && own_label[piece] == 0) own_label[piece] = ++count;
    if (!is_kept) removed += end - first;
    std::fill(labels.values().begin() + static_cast<std::ptrdiff_t>(first),
              labels.values().begin() + static_cast<std::ptrdiff_t>(end), own_label[piece]);
  });
  return removed;
}

}  // namespace carpus::imaging
