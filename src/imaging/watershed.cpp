// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Quantise the relief. 2. Queue, at its own level, each unlabelled voxel that touches a marker.
// 3. Take the first voxel of the lowest level; it gets the label of its basin (or becomes a dam);
// its unlabelled neighbours are queued at their level, but never below the present one. 4. Repeat.
// The queue is one linked list a level through the voxels: every voxel is queued at most once.
#include "imaging/watershed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace carpus::imaging {
namespace {

constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();

/// First-in-first-out lists, one a level.
class LevelQueue {
 public:
  LevelQueue(std::size_t voxels, int levels)
      : next_(voxels, kEnd),
        head_(static_cast<std::size_t>(levels), kEnd),
        tail_(static_cast<std::size_t>(levels), kEnd) {}

  void push(std::size_t level, std::uint32_t voxel) {
    if (head_[level] == kEnd) {
      head_[level] = voxel;
    } else {
      next_[tail_[level]] = voxel;
    }
    tail_[level] = voxel;
  }
  /// The first voxel at `level`, or kEnd.
  std::uint32_t pop(std::size_t level) {
    const std::uint32_t voxel = head_[level];
    if (voxel != kEnd) head_[level] = next_[voxel];
    return voxel;
  }

 private:
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> head_;
  std::vector<std::uint32_t> tail_;
};

class Flood {
 public:
  Flood(const GridView<const float>& relief,
        std::span<const std::uint8_t> mask,
        const WatershedOptions& options,
        const GridView<RegionLabel>& labels)
      : relief_(relief),
        options_(options),
        labels_(labels),
        queue_(relief.values().size(), options.levels),
        neighbours_(relief.geometry(), options.space, options.connectivity),
        state_(relief.values().size(), kOpen) {
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (labels[i] != 0) {
        state_[i] = kMarker;
      } else if (!mask.empty() && mask[i] == 0) {
        state_[i] = kOutside;
      } else {
        ++to_flood_;
      }
    }
    mark_inner();
    measure_relief();
  }

  void run() {
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (is_open(i)) queue_if_touching_marker(i);
    }
    for (std::size_t level = 0; level < static_cast<std::size_t>(options_.levels); ++level) {
      for (std::uint32_t i = queue_.pop(level); i != kEnd; i = queue_.pop(level)) {
        settle(i, level);
        if ((++settled_ & kReportMask) == 0) report();
      }
    }
  }

 private:
  void measure_relief() {
    float high = -std::numeric_limits<float>::infinity();
    low_ = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < state_.size(); ++i) {
      const float v = relief_[i];
      if (!is_open(i) || !std::isfinite(v)) continue;
      low_ = std::min(low_, v);
      high = std::max(high, v);
    }
    scale_ = high > low_ ? static_cast<float>(options_.levels - 1) / (high - low_) : 0.0F;
  }

  [[nodiscard]] std::size_t level_of(std::size_t i) const {
    const auto top = static_cast<std::size_t>(options_.levels - 1);
    const float v = relief_[i];
    if (!std::isfinite(v)) return top;
    return std::min(top, static_cast<std::size_t>((v - low_) * scale_));
  }

  /// What a voxel is: the low bits; kInner beside it where all its neighbours lie in the grid.
  static constexpr std::uint8_t kOpen = 0;
  static constexpr std::uint8_t kMarker = 1;
  static constexpr std::uint8_t kOutside = 2;
  static constexpr std::uint8_t kQueued = 3;
  static constexpr std::uint8_t kStateBits = 3;
  static constexpr std::uint8_t kInner = 4;
  static constexpr std::size_t kReportMask = (std::size_t{1} << 20U) - 1;

  [[nodiscard]] bool is_open(std::size_t i) const { return (state_[i] & kStateBits) == kOpen; }

  /// The flood asks for neighbours at random places: whether a voxel lies on a side of the volume
  /// is found out once, in order, without divisions.
  void mark_inner() {
    const std::array<int, 3>& size = relief_.geometry().size;
    const bool in_slices = options_.space == FloodSpace::Slices;
    std::size_t i = 0;
    for (int z = 0; z < size[2]; ++z) {
      for (int y = 0; y < size[1]; ++y) {
        const bool inner_row =
            y > 0 && y + 1 < size[1] && (in_slices || (z > 0 && z + 1 < size[2]));
        for (int x = 0; x < size[0]; ++x, ++i) {
          if (inner_row && x > 0 && x + 1 < size[0]) state_[i] |= kInner;
        }
      }
    }
  }

  template <typename Visit>
  void for_neighbours(std::size_t i, const Visit& visit) const {
    if ((state_[i] & kInner) != 0) {
      neighbours_.for_each_of_inner(i, visit);
    } else {
      neighbours_.for_each(i, visit);
    }
  }

  void report() const {
    options_.progress("watershed", static_cast<double>(settled_) / static_cast<double>(to_flood_));
  }

  void queue_if_touching_marker(std::size_t i) {
    RegionLabel found = 0;
    for_neighbours(i, [&](std::size_t j) {
      // Markers only: a label just given to a queued neighbour is not one.
      if (found == 0 && (state_[j] & kStateBits) == kMarker) found = labels_[j];
    });
    if (found != 0) enqueue(i, found, 0);
  }

  void enqueue(std::size_t i, RegionLabel label, std::size_t current_level) {
    state_[i] |= kQueued;
    if (!options_.keep_dams) labels_[i] = label;
    queue_.push(std::max(level_of(i), current_level), static_cast<std::uint32_t>(i));
  }

  void settle(std::size_t i, std::size_t level) {
    if (options_.keep_dams && !claim_or_dam(i)) return;
    const RegionLabel label = labels_[i];
    for_neighbours(i, [&](std::size_t j) {
      if (is_open(j)) enqueue(j, label, level);
    });
  }

  /// Gives voxel i the only label around it; false where there are two, so that it stays a dam.
  bool claim_or_dam(std::size_t i) {
    RegionLabel found = 0;
    bool several = false;
    for_neighbours(i, [&](std::size_t j) {
      const RegionLabel label = labels_[j];
      if (label == 0) return;
      several = several || (found != 0 && found != label);
      found = label;
    });
    if (several) return false;
    labels_[i] = found;
    return true;
  }

  GridView<const float> relief_;
  WatershedOptions options_;
  GridView<RegionLabel> labels_;
  LevelQueue queue_;
  Neighbourhood neighbours_;
  std::vector<std::uint8_t> state_;
  std::size_t to_flood_ = 0;
  std::size_t settled_ = 0;
  float low_ = 0;
  float scale_ = 0;
};

}  // namespace

void flood_from_markers(const GridView<const float>& relief,
                        std::span<const std::uint8_t> mask,
                        const WatershedOptions& options,
                        const GridView<RegionLabel>& labels) {
  CARPUS_CHECK(options.levels > 0);
  CARPUS_CHECK(labels.values().size() == relief.values().size());
  CARPUS_CHECK(mask.empty() || mask.size() == relief.values().size());
  CARPUS_CHECK(relief.values().size() < kEnd);
  Flood(relief, mask, options, labels).run();
}

}  // namespace carpus::imaging
