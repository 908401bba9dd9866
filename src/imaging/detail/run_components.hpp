// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Components of equal values, held as runs along x. Private to imaging. Runs are joined with those
// they touch in the row before and the slice before (union-find), which visits memory in order
// [rosenfeld1966sequential]; a volume of numbers would be twice as large as the scan.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::imaging::detail {

/// Voxels of one value in one row, side by side.
struct Run {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t component = 0;  ///< 1.. in the order of their first voxel
};

class RunComponents {
 public:
  /// Of the voxels that are of a kind but 0, joined over faces to those of the same kind.
  /// @param kind_of  of a voxel's value.
  template <typename T, typename KindOf = std::identity>
  explicit RunComponents(const GridView<const T>& values, const KindOf& kind_of = {})
      : nx_(static_cast<std::size_t>(values.geometry().size[0])) {
    find_runs(values, kind_of);
    join_all(values, kind_of);
    number();
  }

  /// [component] number of voxels; [0] = 0.
  [[nodiscard]] const std::vector<std::size_t>& voxels() const noexcept { return voxels_; }

  /// Calls visit(first, end, component) for each run, in the order of memory; voxels first to
  /// end - 1 are it.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t row = 0; row + 1 < first_of_row_.size(); ++row) {
      for (std::uint32_t r = first_of_row_[row]; r < first_of_row_[row + 1]; ++r) {
        visit(row * nx_ + runs_[r].begin, row * nx_ + runs_[r].end, runs_[r].component);
      }
    }
  }

 private:
  template <typename T, typename KindOf>
  void find_runs(const GridView<const T>& values, const KindOf& kind_of) {
    const std::size_t rows = nx_ == 0 ? 0 : values.values().size() / nx_;
    first_of_row_.reserve(rows + 1);
    for (std::size_t row = 0; row < rows; ++row) {
      first_of_row_.push_back(static_cast<std::uint32_t>(runs_.size()));
      const T* value = values.values().data() + row * nx_;
      for (std::size_t x = 0; x < nx_;) {
        const auto own = kind_of(value[x]);
        const std::size_t begin = x;
        while (x < nx_ && kind_of(value[x]) == own) ++x;
        if (own == decltype(own){}) continue;
        // A forest at first: each run's component is its parent, the root the smallest number.
        runs_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(x),
                         static_cast<std::uint32_t>(runs_.size())});
      }
    }
    first_of_row_.push_back(static_cast<std::uint32_t>(runs_.size()));
  }

  std::uint32_t root(std::uint32_t i) {
    while (runs_[i].component != i) {
      i = runs_[i].component = runs_[runs_[i].component].component;
    }
    return i;
  }

  template <typename T, typename KindOf>
  void join_rows(const GridView<const T>& values,
                 const KindOf& kind_of,
                 std::size_t row_a,
                 std::size_t row_b) {
    std::uint32_t a = first_of_row_[row_a];
    std::uint32_t b = first_of_row_[row_b];
    while (a < first_of_row_[row_a + 1] && b < first_of_row_[row_b + 1]) {
      const Run& ra = runs_[a];
      const Run& rb = runs_[b];
      const bool a_ends = ra.end < rb.end;
      if (ra.begin < rb.end && rb.begin < ra.end &&
          kind_of(values[row_a * nx_ + ra.begin]) == kind_of(values[row_b * nx_ + rb.begin])) {
        const std::uint32_t root_a = root(a);
        const std::uint32_t root_b = root(b);
        runs_[std::max(root_a, root_b)].component = std::min(root_a, root_b);
      }
      (a_ends ? a : b)++;
    }
  }

  template <typename T, typename KindOf>
  void join_all(const GridView<const T>& values, const KindOf& kind_of) {
    const auto ny = static_cast<std::size_t>(values.geometry().size[1]);
    for (std::size_t row = 0; row + 1 < first_of_row_.size(); ++row) {
      if (row % ny != 0) join_rows(values, kind_of, row - 1, row);
      if (row >= ny) join_rows(values, kind_of, row - ny, row);
    }
  }

  /// A parent has a smaller number than its children: in one sweep all that lies before a run has
  /// its component already.
  void number() {
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      Run& run = runs_[r];
      if (run.component == r) {
        run.component = static_cast<std::uint32_t>(voxels_.size());
        voxels_.push_back(0);
      } else {
        run.component = runs_[run.component].component;
      }
      voxels_[run.component] += run.end - run.begin;
    }
  }

  std::size_t nx_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> first_of_row_;  ///< rows + 1 entries
  std::vector<std::size_t> voxels_{0};
};

}  // namespace carpus::imaging::detail
