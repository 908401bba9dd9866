// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/shrinking_rings.hpp"

#include <array>
#include <limits>

#include "core/check.hpp"
#include "geometry/predicates.hpp"

namespace carpus::hull {
namespace {

constexpr std::size_t kMost = ShrinkingRings::kMostNeighbours;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The hull's facets over the ring of a removed vertex.
class HoleTriangulation {
 public:
  HoleTriangulation(std::span<const Vec3> vertices, std::span<const std::uint32_t> ring)
      : vertices_(vertices), ring_(ring) {
    fill(0, ring.size() - 1);
  }
  /// Whether an edge joins the positions i and j of the ring.
  [[nodiscard]] bool joins(std::size_t i, std::size_t j) const {
    return (joined_[i] >> j & 1U) != 0;
  }

 private:
  [[nodiscard]] const Vec3& at(std::size_t i) const { return vertices_[ring_[i]]; }

  /// The part of the hole between first and last, whose edge last -> first is known.
  void fill(std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    std::size_t best = first + 1;
    for (std::size_t j = first + 2; j < last; ++j) {
      if (orient3d(at(last), at(first), at(best), at(j)) > 0) best = j;
    }
    if (best - first > 1) join(first, best);
    if (last - best > 1) join(best, last);
    fill(first, best);
    fill(best, last);
  }
  void join(std::size_t i, std::size_t j) {
    joined_[i] |= 1U << j;
    joined_[j] |= 1U << i;
  }

  std::span<const Vec3> vertices_;
  std::span<const std::uint32_t> ring_;
  std::array<std::uint32_t, kMost> joined_{};
};

}  // namespace

ShrinkingRings::ShrinkingRings(const ConvexPolytope& polytope)
    : vertices_(polytope.vertices), rings_(polytope.vertices.size()) {
  const auto& facets = polytope.facets;
  std::vector<std::uint32_t> some_facet(rings_.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (const std::uint32_t v : facets[f]) some_facet[v] = f;
  }
  spokes_.reserve(3 * facets.size());
  std::vector<std::array<std::uint32_t, 3>> spoke_of(facets.size());
  for (std::uint32_t v = 0; v < rings_.size(); ++v) {
    Ring& ring = rings_[v];
    ring.first = static_cast<std::uint32_t>(spokes_.size());
    std::uint32_t f = some_facet[v];
    do {
      const Triangle& t = facets[f];
      const std::size_t i = t[0] == v ? 0 : (t[1] == v ? 1 : 2);
      const auto spoke = static_cast<std::uint32_t>(spokes_.size());
      spoke_of[f][i] = spoke;
      spokes_.push_back({t[(i + 1) % 3], spoke + 1, spoke - 1, kNone, kWholeGap + ring.size});
      ++ring.size;
      f = polytope.neighbours[f][(i + 2) % 3];  // across the edge that ends at v
    } while (f != some_facet[v]);
    link(static_cast<std::uint32_t>(spokes_.size() - 1), ring.first);
  }
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t g = polytope.neighbours[f][i];
      const std::uint32_t start = facets[f][(i + 1) % 3];  // of the same edge in g
      const std::size_t j = facets[g][0] == start ? 0 : (facets[g][1] == start ? 1 : 2);
      spokes_[spoke_of[f][i]].twin = spoke_of[g][j];
    }
  }
}

void ShrinkingRings::remove(std::uint32_t vertex, std::vector<Removal>& removals) {
  const std::size_t k = rings_[vertex].size;
  CARPUS_CHECK(k <= kMost);
  std::array<std::uint32_t, kMost> ring{};
  std::array<Spoke, kMost> inwards{};             // from the ring to the vertex
  std::array<std::uint32_t, 2 * kMost> unused{};  // spokes, which the new edges take
  std::uint32_t at = rings_[vertex].first;
  for (std::size_t i = 0; i < k; ++i) {
    ring[i] = spokes_[at].to;
    inwards[i] = spokes_[spokes_[at].twin];
    unused[2 * i] = at;
    unused[2 * i + 1] = spokes_[at].twin;
    at = spokes_[at].next;
  }
  const HoleTriangulation hole(vertices_, std::span(ring).first(k));
  std::size_t used = 0;
  std::array<std::array<std::uint32_t, kMost>, kMost> spoke{};
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = i + 2; j < k; ++j) {
      if (!hole.joins(i, j)) continue;
      spoke[i][j] = unused[used++];
      spoke[j][i] = unused[used++];
      spokes_[spoke[i][j]].twin = spoke[j][i];
      spokes_[spoke[j][i]].twin = spoke[i][j];
    }
  }
  for (std::size_t i = 0; i < k; ++i) {
    Ring& other = rings_[ring[i]];
    std::uint32_t last = inwards[i].previous;
    removals.push_back({ring[i], vertex, spokes_[last].gap_behind, inwards[i].gap_behind});
    other.first = last;
    --other.size;
    spokes_[last].gap_behind = other.lost;
    for (std::size_t j = i + 2; j + 1 < i + k; ++j) {  // counter-clockwise about ring[i]
      if (!hole.joins(i, j % k)) continue;
      const std::uint32_t added = spoke[i][j % k];
      spokes_[added].to = ring[j % k];
      spokes_[added].gap_behind = other.lost;
      link(last, added);
      last = added;
      ++other.size;
    }
    link(last, inwards[i].next);
    ++other.lost;
  }
  rings_[vertex].size = 0;
}

void ShrinkingRings::list(std::uint32_t vertex, std::vector<Neighbour>& neighbours) const {
  neighbours.clear();
  std::uint32_t at = rings_[vertex].first;
  for (std::size_t i = 0; i < rings_[vertex].size; ++i) {
    neighbours.push_back({spokes_[at].to, spokes_[at].gap_behind});
    at = spokes_[at].next;
  }
}

}  // namespace carpus::hull
