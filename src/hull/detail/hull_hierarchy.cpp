// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Why one neighbour is enough: let no vertex of P_(i+1) be above the plane through w. The vertices
// of P_i above it are then all removed ones. Vertices of a convex polytope above a plane are
// connected by edges, removed ones are not adjacent, so there is at most one; and w, not being
// highest in P_i, has a neighbour that is higher: that one. Ties in the plane change nothing, since
// only "strictly above" counts and is exact.
#include "hull/detail/hull_hierarchy.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/check.hpp"
#include "geometry/predicates.hpp"

namespace carpus::hull {
namespace {

using Ring = std::vector<std::uint32_t>;

/// Neighbours of each vertex, counter-clockwise from outside.
std::vector<Ring> rings_of(const ConvexPolytope& polytope) {
  std::vector<std::uint32_t> some_facet(polytope.vertices.size());
  for (std::uint32_t f = 0; f < polytope.facets.size(); ++f) {
    for (const std::uint32_t v : polytope.facets[f]) some_facet[v] = f;
  }
  std::vector<Ring> rings(polytope.vertices.size());
  for (std::uint32_t v = 0; v < rings.size(); ++v) {
    std::uint32_t f = some_facet[v];
    do {
      const Triangle& t = polytope.facets[f];
      const std::size_t i = t[0] == v ? 0 : (t[1] == v ? 1 : 2);
      rings[v].push_back(t[(i + 1) % 3]);
      f = polytope.neighbours[f][(i + 2) % 3];  // across the edge that ends at v
    } while (f != some_facet[v]);
  }
  return rings;
}

/// Closes the hole that a removed vertex leaves: the hull's facets over its ring. `added[i]` gets
/// the ring positions that position i is joined to.
class HoleTriangulation {
 public:
  HoleTriangulation(std::span<const Vec3> vertices, const Ring& ring)
      : vertices_(vertices), ring_(ring), added_(ring.size()) {
    fill(0, ring.size() - 1);
  }
  /// Positions joined to position i, in the order of the ring behind i.
  [[nodiscard]] Ring joined_to(std::size_t i) const {
    Ring joined = added_[i];
    const std::size_t k = ring_.size();
    std::sort(joined.begin(), joined.end(),
              [&](std::uint32_t a, std::uint32_t b) { return (a + k - i) % k < (b + k - i) % k; });
    return joined;
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
    added_[i].push_back(static_cast<std::uint32_t>(j));
    added_[j].push_back(static_cast<std::uint32_t>(i));
  }

  std::span<const Vec3> vertices_;
  const Ring& ring_;
  std::vector<Ring> added_;
};

void remove_vertex(std::span<const Vec3> vertices, std::vector<Ring>& rings, std::uint32_t v) {
  const Ring ring = std::move(rings[v]);
  const HoleTriangulation hole(vertices, ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Ring& other = rings[ring[i]];
    const auto place = std::find(other.begin(), other.end(), v);
    CARPUS_CHECK(place != other.end());
    const Ring joined = hole.joined_to(i);
    const auto next = other.erase(place);
    const auto inserted = other.insert(next, joined.begin(), joined.end());
    std::for_each(inserted, inserted + static_cast<std::ptrdiff_t>(joined.size()),
                  [&](std::uint32_t& position) { position = ring[position]; });
  }
}

}  // namespace

HullHierarchy::Lists::Lists(const std::vector<std::vector<std::uint32_t>>& lists) {
  begin.reserve(lists.size() + 1);
  begin.push_back(0);
  for (const auto& list : lists) {
    items.insert(items.end(), list.begin(), list.end());
    begin.push_back(static_cast<std::uint32_t>(items.size()));
  }
}

HullHierarchy::HullHierarchy(ConvexPolytope polytope) : polytope_(std::move(polytope)) {
  std::vector<Ring> rings = rings_of(polytope_);
  rings_ = Lists(rings);
  std::vector<Ring> removed(rings.size());
  top_.resize(rings.size());
  for (std::uint32_t v = 0; v < top_.size(); ++v) top_[v] = v;
  std::vector<std::size_t> blocked_in(rings.size(), 0);
  for (std::size_t level = 1; top_.size() > kTopVertices; ++level) {
    std::size_t left = top_.size();
    const auto goes = [&](std::uint32_t v) {
      if (left <= kTopVertices || blocked_in[v] == level || rings[v].size() > kMostNeighbours) {
        return false;
      }
      for (const std::uint32_t w : rings[v]) {
        blocked_in[w] = level;
        removed[w].push_back(v);
      }
      remove_vertex(polytope_.vertices, rings, v);
      --left;
      return true;
    };
    // Not erase_if, whose order of calls is not promised.
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t v : top_) {
      if (!goes(v)) kept.push_back(v);
    }
    top_ = std::move(kept);
  }
  removed_neighbours_ = Lists(removed);
}

std::uint32_t HullHierarchy::touch(const TurningLine& line, HullStatistics& statistics) const {
  const std::vector<Vec3>& vertices = polytope_.vertices;
  const auto off_line = std::find_if(top_.begin(), top_.end(), [&](std::uint32_t v) {
    return !are_collinear(line.a, line.b, vertices[v]);
  });
  CARPUS_CHECK(off_line != top_.end());
  std::uint32_t best = *off_line;
  TurningPlane plane(line, vertices[best]);
  const auto turn_to = [&](std::uint32_t v) {
    if (plane.side_of(vertices[v], statistics) <= 0) return false;
    best = v;
    plane = TurningPlane(line, vertices[v]);
    return true;
  };
  for (const std::uint32_t v : top_) turn_to(v);
  // A removed vertex has only neighbours that were removed at earlier steps, so that its list goes
  // on where the other one is left.
  std::span<const std::uint32_t> list = removed_neighbours_.of(best);
  while (!list.empty()) {
    const bool turned = turn_to(list.back());
    list = turned ? removed_neighbours_.of(best) : list.first(list.size() - 1);
  }
  return best;
}

void HullHierarchy::add_face(const TurningPlane& plane,
                             std::uint32_t vertex,
                             std::vector<std::uint32_t>& input_indices,
                             HullStatistics& statistics) const {
  std::vector<std::uint32_t> found{vertex};
  for (std::size_t i = 0; i < found.size(); ++i) {
    input_indices.push_back(polytope_.input_indices[found[i]]);
    for (const std::uint32_t w : rings_.of(found[i])) {
      if (std::find(found.begin(), found.end(), w) != found.end()) continue;
      if (plane.side_of(polytope_.vertices[w], statistics) == 0) found.push_back(w);
    }
  }
}

}  // namespace carpus::hull
