// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of many moving boxes overlap? Incremental sweep and prune, the broad phase of I-COLLIDE.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/aabb.hpp"

namespace carpus::survey {

/// Two of n things by number, first < second. Pairs are numbered (0, 1), (0, 2), ... (n - 2, n -
/// 1).
struct IndexPair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  bool operator==(const IndexPair&) const = default;
};

[[nodiscard]] constexpr std::size_t pair_count_of(std::size_t n) noexcept {
  return n * (n - (n > 0 ? 1 : 0)) / 2;
}
/// @param first, second  first < second < n.
[[nodiscard]] constexpr std::size_t pair_number(std::size_t first,
                                                std::size_t second,
                                                std::size_t n) noexcept {
  return first * (2 * n - first - 1) / 2 + (second - first - 1);
}

enum class SweepStatus : std::uint8_t {
  Ok,
  NotANumber,  ///< some box has a NaN: it counts as all of space, so that no contact is lost
};

/// Sums over all updates since the start.
struct SweepCounts {
  std::uint64_t updates = 0;
  std::uint64_t swaps = 0;       ///< of neighbouring ends of intervals
  std::uint64_t full_sorts = 0;  ///< cold, or the order had changed too much to follow it
};

/// The ends of all boxes are kept sorted along each axis from update to update. Boxes that move a
/// little cost an insertion sort that finds everything nearly in place; each swap of a lower end
/// with an upper one switches one pair's overlap on that axis. Boxes overlap if they do on all
/// three. Closed boxes: touching is overlapping; an empty box overlaps nothing. The pairs depend on
/// the boxes alone, bit for bit, not on what was there before.
/// Real-time: noexcept, no allocation after construction. An update costs O(n + swaps + n^2 / 64);
/// past 16 n swaps on an axis it starts over with O(n log n + overlaps on each axis).
/// Source: [cohen1995icollide] §4.1.
class SweepAndPrune {
 public:
  static constexpr std::size_t kMaxBoxes = 32768;

  /// @throws InvalidInput for more than kMaxBoxes boxes.
  explicit SweepAndPrune(std::size_t box_count);

  [[nodiscard]] std::size_t box_count() const noexcept { return box_count_; }

  /// @param boxes  as many as at construction, in one frame [mm].
  SweepStatus update(std::span<const Aabb> boxes) noexcept;
  /// As if there had been no update: the next one is cold and every pair in it begins.
  void forget() noexcept;

  [[nodiscard]] bool overlap(std::size_t first, std::size_t second) const noexcept {
    const std::size_t number = pair_number(first, second, box_count_);
    return (now_[number / 64] >> (number % 64) & 1U) != 0;
  }
  [[nodiscard]] std::size_t overlapping_count() const noexcept;

  /// One bit a pair, by pair_number.
  [[nodiscard]] std::span<const std::uint64_t> overlap_bits() const noexcept { return now_; }
  [[nodiscard]] IndexPair pair(std::size_t number) const noexcept { return pairs_[number]; }

  /// Calls visit(IndexPair) for each pair that overlaps, ascending.
  template <typename Visit>
  void for_each_overlapping(Visit&& visit) const {
    for (std::size_t w = 0; w < now_.size(); ++w) visit_bits(w, now_[w], visit);
  }
  /// Pairs that overlap since the last update and did not in the one before it.
  template <typename Visit>
  void for_each_begun(Visit&& visit) const {
    for (std::size_t w = 0; w < now_.size(); ++w) visit_bits(w, now_[w] & ~before_[w], visit);
  }
  /// Pairs that overlapped in the update before the last one and do not any more.
  template <typename Visit>
  void for_each_ended(Visit&& visit) const {
    for (std::size_t w = 0; w < now_.size(); ++w) visit_bits(w, before_[w] & ~now_[w], visit);
  }

  [[nodiscard]] const SweepCounts& counts() const noexcept { return counts_; }

 private:
  /// One end of a box's interval. `end` is twice the box's number, plus one for the upper end.
  struct End {
    double value = 0;
    std::uint32_t end = 0;
  };
  using Bits = std::vector<std::uint64_t>;

  template <typename Visit>
  void visit_bits(std::size_t word, std::uint64_t bits, Visit& visit) const {
    for (; bits != 0; bits &= bits - 1) {
      visit(pairs_[word * 64 + static_cast<std::size_t>(std::countr_zero(bits))]);
    }
  }

  SweepStatus take(std::span<const Aabb> boxes) noexcept;
  void switch_pair(Bits& bits, std::uint32_t end, std::uint32_t other) noexcept;
  [[nodiscard]] bool follow(std::size_t axis) noexcept;
  void sort(std::size_t axis) noexcept;
  void clear_empty_boxes() noexcept;

  std::size_t box_count_;
  bool is_cold_ = true;
  bool some_are_empty_ = false;
  std::vector<IndexPair> pairs_;
  std::array<std::vector<double>, 3> values_;  ///< [axis][end]
  std::array<std::vector<End>, 3> ends_;       ///< [axis], ascending
  std::array<Bits, 3> axis_bits_;              ///< [axis], by pair_number: the intervals overlap
  Bits now_;
  Bits before_;
  std::vector<std::uint8_t> is_empty_;
  std::vector<std::uint32_t> open_;  ///< scratch: boxes whose intervals a sweep is inside
  SweepCounts counts_;
};

}  // namespace carpus::survey
