// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The neighbours of each vertex of a convex polytope that loses one vertex after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex_polytope.hpp"

namespace carpus::hull {

/// Of one vertex, what is between a neighbour and the next one counter-clockwise: kWholeGap + i if
/// these are the neighbours i and i + 1 of the whole polytope; else r: the r-th vertex (from 0)
/// that was removed from the ring was between them, alone or with others that took its place.
using RingGap = std::uint32_t;
inline constexpr RingGap kWholeGap = 1U << 31U;

/// Rings of neighbours, counter-clockwise from outside, as linked lists: a removal costs the same
/// however many neighbours its neighbours have.
class ShrinkingRings {
 public:
  /// Vertices with more neighbours cannot be removed. Fewer than six on average, hence most have at
  /// most eight.
  static constexpr std::size_t kMostNeighbours = 8;

  struct Neighbour {
    std::uint32_t vertex;
    RingGap gap_behind;
  };
  /// `removed` was a neighbour of `vertex`.
  struct Removal {
    std::uint32_t vertex;
    std::uint32_t removed;
    RingGap gap_before;  ///< between the neighbour before it and it
    RingGap gap_behind;
  };

  explicit ShrinkingRings(const ConvexPolytope& polytope);

  /// A vertex becomes the hull of the others without it: closes the hole over its ring.
  /// Adds what it was to its neighbours to `removals`.
  void remove(std::uint32_t vertex, std::vector<Removal>& removals);

  [[nodiscard]] std::size_t size_of(std::uint32_t vertex) const { return rings_[vertex].size; }
  /// How many neighbours the vertex has lost.
  [[nodiscard]] std::size_t lost_by(std::uint32_t vertex) const { return rings_[vertex].lost; }
  void list(std::uint32_t vertex, std::vector<Neighbour>& neighbours) const;

 private:
  struct Spoke {
    std::uint32_t to;
    std::uint32_t next;
    std::uint32_t previous;
    std::uint32_t twin;
    RingGap gap_behind;
  };
  struct Ring {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
    std::uint32_t lost = 0;
  };

  void link(std::uint32_t before, std::uint32_t behind) {
    spokes_[before].next = behind;
    spokes_[behind].previous = before;
  }

  std::span<const Vec3> vertices_;
  std::vector<Spoke> spokes_;
  std::vector<Ring> rings_;
};

}  // namespace carpus::hull
