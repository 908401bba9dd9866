// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/facet_queue.hpp"

namespace carpus::hull {

void FacetQueue::divide(const Vec3& low, const Vec3& extent, std::uint32_t per_axis) {
  per_axis_ = per_axis;
  last_ = per_axis - 1;
  low_ = low;
  for (std::size_t axis = 0; axis < 3; ++axis) cells_per_mm_[axis] = per_axis / extent[axis];
  cells_.resize(std::size_t{per_axis} * per_axis * per_axis);
  current_ = static_cast<std::uint32_t>(cells_.size());
}

void FacetQueue::clear() { *this = FacetQueue(); }

bool FacetQueue::next_cell() {
  for (const Deferred& d : deferred_) cells_[d.cell].push_back(d.entry);
  in_cells_ += deferred_.size();
  deferred_.clear();
  entries_.clear();
  head_ = 0;
  if (in_cells_ == 0) return false;
  do {
    current_ = current_ + 1 < cells_.size() ? current_ + 1 : 0;
  } while (cells_[current_].empty());
  entries_.swap(cells_[current_]);
  in_cells_ -= entries_.size();
  return true;
}

}  // namespace carpus::hull
