// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Quantise the relief. 2. Queue, at its own level, each unlabelled voxel that touches a marker.
// 3. Take the first voxel of the lowest level; it gets the label of its basin (or becomes a dam);
// its unlabelled neighbours are queued at their level, but never below the present one. 4. Repeat.
// Every voxel is queued at most once.
#include "imaging/watershed.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <vector>

#include "core/large_pages.hpp"
#include "core/widest_vectors.hpp"

namespace carpus::imaging {
namespace {

constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();

/// A voxel that waits, and the label that it gets. A label is written where its voxel is read:
/// written when it is queued, it would touch a line of the cache for each neighbour.
struct Waiting {
  std::uint32_t voxel;
  RegionLabel label;
};

/// First-in-first-out lists of voxels, one a level, in chunks that are used again.
class LevelQueue {
 public:
  explicit LevelQueue(int levels) : lists_(static_cast<std::size_t>(levels)) {}

  void push(std::size_t level, const Waiting& waiting) {
    List& list = lists_[level];
    if (list.end == kChunk || list.last == kEnd) append_chunk(list);
    Chunk& chunk = chunks_[list.last];
    chunk.voxels[list.end] = waiting.voxel;
    chunk.labels[list.end++] = waiting.label;
  }
  [[nodiscard]] bool is_empty(std::size_t level) const {
    const List& list = lists_[level];
    return list.first == kEnd || (list.first == list.last && list.begin == list.end);
  }
  /// The first at `level`, which is not empty.
  Waiting pop(std::size_t level) {
    List& list = lists_[level];
    const Chunk& chunk = chunks_[list.first];
    const Waiting first{chunk.voxels[list.begin], chunk.labels[list.begin]};
    if (++list.begin == kChunk) drop_first_chunk(list);
    return first;
  }
  /// The voxel that most likely comes kAhead after the first at `level`, which is not empty; where
  /// none waits there yet, one that was there before.
  [[nodiscard]] std::uint32_t coming(std::size_t level) const {
    const List& list = lists_[level];
    const Chunk& chunk = chunks_[list.first];
    const std::uint32_t at = list.begin + kAhead;
    if (at < kChunk) return chunk.voxels[at];
    return chunk.next != kEnd ? chunks_[chunk.next].voxels[at - kChunk] : chunk.voxels[list.begin];
  }

 private:
  static constexpr std::uint32_t kChunk = 31;  // a chunk fills three lines of a processor's cache
  static constexpr std::uint32_t kAhead = 12;
  struct Chunk {
    std::array<std::uint32_t, kChunk> voxels{};
    std::uint32_t next = kEnd;
    std::array<RegionLabel, kChunk> labels{};
  };
  static_assert(sizeof(Chunk) == 192);
  struct List {
    std::uint32_t first = kEnd;
    std::uint32_t last = kEnd;
    std::uint32_t begin = 0;  ///< in the first chunk
    std::uint32_t end = 0;    ///< in the last chunk
  };

  void append_chunk(List& list) {
    std::uint32_t chunk = free_;
    if (chunk != kEnd) {
      free_ = chunks_[chunk].next;
    } else {
      chunk = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    }
    chunks_[chunk].next = kEnd;
    if (list.last != kEnd) {
      chunks_[list.last].next = chunk;
    } else {
      list.first = chunk;
      list.begin = 0;
    }
    list.last = chunk;
    list.end = 0;
  }
  void drop_first_chunk(List& list) {
    const std::uint32_t dropped = list.first;
    list.first = chunks_[dropped].next;
    if (list.first == kEnd) {
      list.last = kEnd;
    } else if (const std::uint32_t next = chunks_[list.first].next; next != kEnd) {
      __builtin_prefetch(&chunks_[next]);
      __builtin_prefetch(&chunks_[next].voxels[kAhead]);
      __builtin_prefetch(&chunks_[next].labels);
    }
    list.begin = 0;
    chunks_[dropped].next = free_;
    free_ = dropped;
  }

  std::vector<List> lists_;
  std::vector<Chunk, LargePageAllocator<Chunk>> chunks_;
  std::uint32_t free_ = kEnd;
};

/// All that the flood asks of a neighbour, in one short word: it visits voxels at random places,
/// and the fewer lines of the cache they fill, the fewer have to be waited for. Labels are beside
/// it, where only the voxel at hand is written.
class Voxel {
 public:
  enum class State : std::uint16_t { Open, Marker, Outside, Queued };

  Voxel() = default;
  Voxel(State state, std::uint16_t level)
      : word_(static_cast<std::uint16_t>(static_cast<unsigned>(state) << kStateAt | level)) {}

  [[nodiscard]] State state() const { return static_cast<State>(word_ >> kStateAt & 3U); }
  [[nodiscard]] std::size_t level() const { return word_ & (kMostLevels - 1); }
  /// All its neighbours lie in the grid.
  [[nodiscard]] bool is_inner() const { return (word_ & kInner) != 0; }
  void set_inner() { word_ |= kInner; }
  void set_queued() { word_ |= 3U << kStateAt; }

 private:
  static constexpr unsigned kStateAt = 13;
  static constexpr std::uint16_t kInner = 1U << 15U;
  static_assert(kMostLevels == 1 << kStateAt);

  std::uint16_t word_;
};
static_assert(sizeof(Voxel) == 2);

/// The relief in levels between its least and greatest finite value among those that are open.
class Quantiser {
 public:
  Quantiser(int levels, float low, float high)
      : low_(low),
        scale_(high > low ? static_cast<float>(levels - 1) / (high - low) : 0.0F),
        top_(static_cast<float>(levels - 1)) {}

  /// A value that is not finite has the highest. Without branches: rows of it are found side by
  /// side.
  [[nodiscard]] std::uint16_t operator()(float v) const {
    const float level = (v - low_) * scale_;
    return static_cast<std::uint16_t>(
        static_cast<std::int32_t>(level >= 0.0F && level < top_ ? level : top_));
  }

 private:
  float low_;
  float scale_;
  float top_;
};

/// The least and greatest of many values; what is not finite does not count.
class Range {
 public:
  void take(float v) {
    const bool is_finite = std::abs(v) <= std::numeric_limits<float>::max();
    low_ = std::min(low_, is_finite ? v : kInfinity);
    high_ = std::max(high_, is_finite ? v : -kInfinity);
  }
  [[nodiscard]] Quantiser in_levels(int levels) const { return {levels, low_, high_}; }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float low_ = kInfinity;
  float high_ = -kInfinity;
};

class Flood {
 public:
  /// @param voxels  of `labels`, each Open at its level, Marker or Outside.
  Flood(std::span<Voxel> voxels,
        const WatershedOptions& options,
        const GridView<RegionLabel>& labels)
      : options_(options),
        neighbours_(labels.geometry(), options.space, options.connectivity),
        queue_(options.levels),
        voxels_(voxels),
        labels_(labels),
        size_(labels.geometry().size) {}

  void run() {
    queue_around_markers();
    const std::size_t last = voxels_.size() - 1;
    for (std::size_t level = 0; level < static_cast<std::size_t>(options_.levels); ++level) {
      while (!queue_.is_empty(level)) {
        // Where the flood goes next lies anywhere in memory: it is asked for early. (In a function
        // of its own GCC 12 finds that to do nothing, and leaves it out.)
        const std::size_t coming = queue_.coming(level);
        for (const std::ptrdiff_t row : neighbours_.rows()) {
          const std::size_t at = coming + static_cast<std::size_t>(row);
          __builtin_prefetch(&voxels_[std::min(at, last)]);
        }
        __builtin_prefetch(&labels_[coming], 1);
        settle(queue_.pop(level), level);
        if ((++settled_ & kReportMask) == 0) report();
      }
    }
  }

 private:
  static constexpr std::size_t kReportMask = (std::size_t{1} << 20U) - 1;

  [[nodiscard]] bool is_open(std::size_t i) const {
    return voxels_[i].state() == Voxel::State::Open;
  }

  /// Calls visit(y, z, its first voxel) for each row along x, in the order of memory.
  template <typename Visit>
  void for_each_row(const Visit& visit) const {
    std::size_t first = 0;
    for (int z = 0; z < size_[2]; ++z) {
      for (int y = 0; y < size_[1]; ++y, first += static_cast<std::size_t>(size_[0])) {
        visit(y, z, first);
      }
    }
  }

  /// Most rows of a volume are far from any marker, and are not asked voxel by voxel.
  void queue_around_markers() {
    std::vector<std::uint8_t> holds_marker(static_cast<std::size_t>(size_[1]) *
                                           static_cast<std::size_t>(size_[2]));
    for_each_row([&](int y, int z, std::size_t first) {
      holds_marker[row_of(y, z)] = prepare_row(y, z, first) ? 1 : 0;
    });
    const auto is_near_marker = [&](int y, int z) {
      for (int dz = std::max(0, z - 1); dz <= std::min(size_[2] - 1, z + 1); ++dz) {
        for (int dy = std::max(0, y - 1); dy <= std::min(size_[1] - 1, y + 1); ++dy) {
          if (holds_marker[row_of(dy, dz)] != 0) return true;
        }
      }
      return false;
    };
    for_each_row([&](int y, int z, std::size_t first) {
      if (!is_near_marker(y, z)) return;
      for (std::size_t i = first; i < first + static_cast<std::size_t>(size_[0]); ++i) {
        if (is_open(i)) queue_if_touching_marker(i);
      }
    });
  }

  [[nodiscard]] std::size_t row_of(int y, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) +
           static_cast<std::size_t>(y);
  }

  /// Finds out once, in order and without divisions, which voxels of a row lie on a side of the
  /// volume; true where one is a marker.
  bool prepare_row(int y, int z, std::size_t first) {
    const std::span<Voxel> row = voxels_.subspan(first, static_cast<std::size_t>(size_[0]));
    unsigned open = 0;
    unsigned markers = 0;
    for (const Voxel voxel : row) {
      open += voxel.state() == Voxel::State::Open ? 1U : 0U;
      markers += voxel.state() == Voxel::State::Marker ? 1U : 0U;
    }
    to_flood_ += open;
    const bool is_inner = y > 0 && y + 1 < size_[1] &&
                          (options_.space == FloodSpace::Slices || (z > 0 && z + 1 < size_[2]));
    if (is_inner && row.size() > 2) {
      for (Voxel& voxel : row.subspan(1, row.size() - 2)) voxel.set_inner();
    }
    return markers > 0;
  }

  template <typename Visit>
  void for_neighbours(std::size_t i, const Visit& visit) const {
    if (voxels_[i].is_inner()) {
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
      if (found == 0 && voxels_[j].state() == Voxel::State::Marker) found = labels_[j];
    });
    if (found != 0) enqueue(i, found, 0);
  }

  void enqueue(std::size_t i, RegionLabel label, std::size_t current_level) {
    Voxel& voxel = voxels_[i];
    voxel.set_queued();
    queue_.push(std::max(voxel.level(), current_level), {static_cast<std::uint32_t>(i), label});
  }

  /// Which neighbours of an inner voxel are open, a bit each. That cannot be foreseen: they are
  /// asked all at once, without a branch each.
  [[nodiscard]] std::uint32_t open_around_inner(std::size_t i) const {
    const auto bit = [&](int k) {
      return static_cast<std::uint32_t>(is_open(neighbours_.of_inner(i, k))) << k;
    };
    std::uint32_t open = 0;
    for (int k = 0; k < static_cast<int>(neighbours_.count()); ++k) open |= bit(k);
    return open;
  }

  void settle(const Waiting& waiting, std::size_t level) {
    const std::size_t i = waiting.voxel;
    if (options_.keep_dams) {
      if (!claim_or_dam(i)) return;
    } else {
      labels_[i] = waiting.label;
    }
    const RegionLabel label = labels_[i];
    if (!voxels_[i].is_inner()) {
      neighbours_.for_each(i, [&](std::size_t j) {
        if (is_open(j)) enqueue(j, label, level);
      });
      return;
    }
    for (std::uint32_t open = open_around_inner(i); open != 0; open &= open - 1) {
      enqueue(neighbours_.of_inner(i, std::countr_zero(open)), label, level);
    }
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

  WatershedOptions options_;
  Neighbourhood neighbours_;
  LevelQueue queue_;
  std::span<Voxel> voxels_;
  GridView<RegionLabel> labels_;
  std::array<int, 3> size_;
  std::size_t to_flood_ = 0;
  std::size_t settled_ = 0;
};

Voxel voxel_of(bool is_open, std::uint16_t level, RegionLabel label) {
  const Voxel::State closed = label != 0 ? Voxel::State::Marker : Voxel::State::Outside;
  return {is_open ? Voxel::State::Open : closed, is_open ? level : std::uint16_t{0}};
}

void check(const WatershedOptions& options, const GridView<RegionLabel>& labels) {
  CARPUS_CHECK(options.levels > 0 && options.levels <= kMostLevels);
  CARPUS_CHECK(labels.values().size() < kEnd);
}

}  // namespace

void flood_from_markers(const GridView<const float>& relief,
                        std::span<const std::uint8_t> mask,
                        const WatershedOptions& options,
                        const GridView<RegionLabel>& labels) {
  check(options, labels);
  CARPUS_CHECK(labels.values().size() == relief.values().size());
  CARPUS_CHECK(mask.empty() || mask.size() == relief.values().size());
  const std::size_t count = labels.values().size();
  const std::span<const float> heights = relief.values();
  std::vector<Voxel, LargePageAllocator<Voxel>> voxels(count);
  const auto prepare = [&](const auto& is_open) {
    Range range;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_open(i)) range.take(heights[i]);
    }
    const Quantiser level_of = range.in_levels(options.levels);
    CARPUS_INDEPENDENT_TURNS
    for (std::size_t i = 0; i < count; ++i) {
      voxels[i] = voxel_of(is_open(i), level_of(heights[i]), labels[i]);
    }
  };
  if (mask.empty()) {
    prepare([&](std::size_t i) { return labels[i] == 0; });
  } else {
    prepare([&](std::size_t i) { return labels[i] == 0 && mask[i] != 0; });
  }
  Flood(voxels, options, labels).run();
}

void flood_from_markers(Grid<float> relief,
                        const WatershedOptions& options,
                        const GridView<RegionLabel>& labels) {
  check(options, labels);
  CARPUS_CHECK(labels.values().size() == relief.values().size());
  const std::span<float> heights = relief.values();
  if (heights.empty()) return;
  Range range;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (labels[i] == 0) range.take(heights[i]);
  }
  const Quantiser level_of = range.in_levels(options.levels);
  // A voxel is half as long as a height and lies no farther on: where it goes, the heights have
  // been read. It is made there anew, so that nothing is read as what it is not.
  static_assert(sizeof(Voxel) <= sizeof(float) && alignof(Voxel) <= alignof(float));
  auto* const memory = reinterpret_cast<std::byte*>(heights.data());
  Voxel* first = nullptr;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Voxel voxel = voxel_of(labels[i] == 0, level_of(heights[i]), labels[i]);
    Voxel* const made = new (memory + i * sizeof(Voxel)) Voxel(voxel);
    if (i == 0) first = made;
  }
  Flood({first, heights.size()}, options, labels).run();
}

void flood_depths_from_markers(const MaskedValues& depth,
                               const WatershedOptions& options,
                               const GridView<RegionLabel>& labels) {
  check(options, labels);
  CARPUS_CHECK(labels.values().size() == depth.geometry().voxel_count());
  Range range;
  depth.for_each([&](std::size_t i, float value) {
    if (labels[i] == 0) range.take(-value);
  });
  const Quantiser level_of = range.in_levels(options.levels);
  std::vector<Voxel, LargePageAllocator<Voxel>> voxels(labels.values().size());
  for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = voxel_of(false, 0, labels[i]);
  depth.for_each([&](std::size_t i, float value) {
    if (labels[i] == 0) voxels[i] = voxel_of(true, level_of(-value), 0);
  });
  Flood(voxels, options, labels).run();
}

}  // namespace carpus::imaging
