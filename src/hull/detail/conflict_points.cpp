// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two points at a time; no branch depends on a point.
#include "hull/detail/conflict_points.hpp"

#include <algorithm>
#include <limits>

namespace carpus::hull {
void PointBlock::unmark(std::uint32_t nowhere) {
  x_[count_] = x_[count_ - 1];  // the last one twice where the number is odd
  y_[count_] = y_[count_ - 1];
  z_[count_] = z_[count_ - 1];
  const Pair none = both(static_cast<double>(nowhere));
  for (std::size_t i = 0; i < count_; i += 2) store_pair(&slot_[i], none);
}

bool PointBlock::mark_above(const OrientedPlane& plane, std::uint32_t slot) {
  const Pair nx = both(plane.normal.x);
  const Pair ny = both(plane.normal.y);
  const Pair nz = both(plane.normal.z);
  const Pair ox = both(plane.origin.x);
  const Pair oy = both(plane.origin.y);
  const Pair oz = both(plane.origin.z);
  const Pair bound = both(plane.bound);
  const Pair doubt = both(doubt_of(plane));
  const Pair here = both(static_cast<double>(slot));
  Pair least = both(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count_; i += 2) {
    const Pair height = nx * (load_pair(&x_[i]) - ox) + ny * (load_pair(&y_[i]) - oy) +
                        nz * (load_pair(&z_[i]) - oz);
    store_pair(&slot_[i], chosen(height > bound, here, load_pair(&slot_[i])));
    least = lesser(magnitude(height) - doubt, least);
  }
  return std::min(least[0], least[1]) <= 0;
}

}  // namespace carpus::hull
