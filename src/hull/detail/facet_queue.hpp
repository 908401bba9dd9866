// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The order in which fast_hull serves the facets that have points outside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::hull {

/// First in, first out: breadth first, so that far points come early. Once divided, the same within
/// one cell of a grid after another, so that the facets and points at work stay in the cache. What
/// is pushed from one cell to another waits apart until the cell is finished.
class FacetQueue {
 public:
  struct Entry {
    std::uint32_t facet;
    std::uint32_t first_conflict;  ///< as the facet's, or the facet is another by now
  };
  struct Deferred {
    Entry entry;
    std::uint32_t cell;
  };

  [[nodiscard]] bool is_divided() const { return !cells_.empty(); }
  /// From now on by cells, `per_axis` along each axis of the box.
  void divide(const Vec3& low, const Vec3& extent, std::uint32_t per_axis);
  void clear();

  /// @param place  where the facet lies; says the cell.
  void push(const Entry& entry, const Vec3& place) {
    const std::uint32_t cell = is_divided() ? cell_of(place) : 0;
    if (cell == current_) {
      entries_.push_back(entry);
    } else {
      deferred_.push_back({entry, cell});
    }
  }
  /// Of the cell at work.
  [[nodiscard]] bool is_empty() const { return head_ == entries_.size(); }
  Entry pop() { return entries_[head_++]; }
  [[nodiscard]] std::size_t count() const { return entries_.size() - head_; }
  /// What is still to come in the cell at work, for the owner to change.
  [[nodiscard]] std::span<Entry> coming() { return std::span(entries_).subspan(head_); }
  /// What was pushed to other cells since the last next_cell(), for the owner to change.
  [[nodiscard]] std::span<Deferred> deferred() { return deferred_; }
  /// Leaves the entries of other cells for which `keeps` says so after it has changed them.
  template <typename Keeps>
  void filter_other_cells(Keeps keeps) {
    in_cells_ = 0;
    for (std::vector<Entry>& cell : cells_) {
      filter(cell, 0, keeps);
      in_cells_ += cell.size();
    }
  }
  /// The same for the cell at work and what it has deferred.
  template <typename Keeps>
  void filter_current(Keeps keeps) {
    filter(entries_, head_, keeps);
    head_ = 0;
    filter(deferred_, 0, [&](Deferred& d) { return keeps(d.entry); });
  }
  /// Gives what was deferred to its cells and goes on with the next one. @return false: all done.
  bool next_cell();

 private:
  template <typename T, typename Keeps>
  static void filter(std::vector<T>& entries, std::size_t begin, Keeps keeps) {
    std::size_t kept = 0;
    for (std::size_t i = begin; i < entries.size(); ++i) {
      if (keeps(entries[i])) entries[kept++] = entries[i];
    }
    entries.resize(kept);
  }

  [[nodiscard]] std::uint32_t cell_of(const Vec3& place) const {
    std::uint32_t cell = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const double along = (place[axis] - low_[axis]) * cells_per_mm_[axis];
      const auto i = static_cast<std::uint32_t>(along < last_ ? (along > 0 ? along : 0) : last_);
      cell = cell * per_axis_ + i;
    }
    return cell;
  }

  std::vector<Entry> entries_;
  std::size_t head_ = 0;
  std::vector<Deferred> deferred_;
  std::uint32_t current_ = 0;
  std::vector<std::vector<Entry>> cells_;
  std::size_t in_cells_ = 0;
  std::uint32_t per_axis_ = 1;
  double last_ = 0;
  Vec3 low_;
  Vec3 cells_per_mm_;
};

}  // namespace carpus::hull
