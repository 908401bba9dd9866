// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Why one neighbour is enough: let no vertex of P_(i+1) be above the plane through w. The vertices
// of P_i above it are then all removed ones. Vertices of a convex polytope above a plane are
// connected by edges, removed ones are not adjacent, so there is at most one; and w, not being
// highest in P_i, has a neighbour that is higher: that one. Ties in the plane change nothing, since
// only "strictly above" counts and is exact.
//
// Which one it is, without asking all that w lost [edelsbrunner1985extreme]: seen along a line in
// the plane through w, the polytope is a polygon, w a corner of it, and two edges at w, to left and
// right, lead to the corners beside it. What is above the plane is beyond the line of one of these
// edges, hence sees a facet beside it; so it was between this edge's end and a neighbour of that in
// the ring of w. Four gaps in the ring are to be watched, whatever its length. The line is the one
// from w through a point of the turning line ("pole"), so that all signs are orientations of four
// vertices. If a neighbour is in the plane, then the plane touches in an edge, and its end alone
// is to be watched. All this holds as well for vertices that come back one by one.
#include "hull/detail/hull_hierarchy.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "core/check.hpp"
#include "geometry/predicates.hpp"

namespace carpus::hull {
namespace {

/// A neighbour of a vertex and the gaps beside it.
struct WatchedNeighbour {
  std::uint32_t vertex;
  RingGap before;
  RingGap behind;
};

/// The number in its list of the last removed vertex that comes back in a gap, or -1.
std::int64_t newest(RingGap gap) { return gap < kWholeGap ? static_cast<std::int64_t>(gap) : -1; }
std::int64_t newest(const WatchedNeighbour& n) {
  return std::max(newest(n.before), newest(n.behind));
}

/// The neighbours of a vertex that bound its ring seen from a pole, or one that is in a plane which
/// touches the vertex.
class Silhouette {
 public:
  Silhouette(std::span<const Vec3> vertices,
             const Vec3& pole,
             const Vec3& vertex,
             HullStatistics& statistics)
      : vertices_(vertices), pole_(pole), vertex_(vertex), statistics_(statistics) {}

  /// A neighbour of the ring to start from; `side` is its side of the plane, not above.
  void start_with(const WatchedNeighbour& n, int side) {
    if (is_in_plane_) return;
    if (side == 0 || !is_started_) {
      is_started_ = true;
      is_in_plane_ = side == 0;
      sides_ = {n, n};
    } else if (is_beyond(0, n.vertex)) {
      sides_[0] = n;
    } else if (is_beyond(1, n.vertex)) {
      sides_[1] = n;
    }
  }

  /// A vertex comes back, not above the plane, between two gaps of its own.
  void insert(std::int64_t number, const WatchedNeighbour& n, int side) {
    if (side == 0 && !is_in_plane_) {
      is_in_plane_ = true;
      sides_ = {n, n};
      return;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      WatchedNeighbour& watched = sides_[i];
      const bool is_before = newest(watched.before) == number;
      const bool is_behind = newest(watched.behind) == number;
      if (!is_before && !is_behind) continue;
      // Between two gaps that it fills, the watched neighbour is one no more.
      if ((is_before && is_behind) || (!is_in_plane_ && is_beyond(i, n.vertex))) {
        watched = n;
      } else if (is_before) {
        watched.before = n.behind;
      } else {
        watched.behind = n.before;
      }
    }
    if (is_in_plane_) sides_[1] = sides_[0];
  }

  [[nodiscard]] std::int64_t next() const { return std::max(newest(sides_[0]), newest(sides_[1])); }
  [[nodiscard]] bool is_in_plane() const { return is_in_plane_; }
  [[nodiscard]] RingGap behind() const { return sides_[0].behind; }

 private:
  /// All images but those in the plane are in an open half-plane, hence in order.
  bool is_beyond(std::size_t i, std::uint32_t v) {
    const int sign =
        counted_orient3d(pole_, vertex_, vertices_[sides_[i].vertex], vertices_[v], statistics_);
    return i == 0 ? sign > 0 : sign < 0;
  }

  std::span<const Vec3> vertices_;
  const Vec3& pole_;
  const Vec3& vertex_;
  HullStatistics& statistics_;
  std::array<WatchedNeighbour, 2> sides_{};
  bool is_started_ = false;
  bool is_in_plane_ = false;
};

}  // namespace

HullHierarchy::HullHierarchy(ConvexPolytope polytope, std::size_t short_list)
    : polytope_(std::move(polytope)), top_(polytope_.vertices.size()) {
  std::iota(top_.begin(), top_.end(), 0U);
  ShrinkingRings rings(polytope_);
  std::vector<ShrinkingRings::Neighbour> ring;
  rings_.items.reserve(3 * polytope_.facets.size());
  for (const std::uint32_t v : top_) {
    rings_.begin.push_back(static_cast<std::uint32_t>(rings_.items.size()));
    rings.list(v, ring);
    for (const auto& neighbour : ring) rings_.items.push_back(neighbour.vertex);
  }
  rings_.begin.push_back(static_cast<std::uint32_t>(rings_.items.size()));
  std::vector<ShrinkingRings::Removal> removals;
  remove_vertices(rings, short_list, removals);
  sort_by_vertex(removals);
}

void HullHierarchy::remove_vertices(ShrinkingRings& rings,
                                    std::size_t short_list,
                                    std::vector<ShrinkingRings::Removal>& removals) {
  std::vector<ShrinkingRings::Neighbour> ring;
  const auto keep_ring = [&](std::uint32_t v) {
    if (rings.lost_by(v) > short_list) rings.list(v, growing_rings_[v].first);
  };
  std::vector<std::size_t> blocked_in(top_.size(), 0);
  for (std::size_t level = 1; top_.size() > kTopVertices; ++level) {
    std::size_t left = top_.size();
    const auto goes = [&](std::uint32_t v) {
      if (left <= kTopVertices || blocked_in[v] == level ||
          rings.size_of(v) > ShrinkingRings::kMostNeighbours) {
        return false;
      }
      keep_ring(v);
      const std::size_t first = removals.size();
      rings.remove(v, removals);
      for (std::size_t i = first; i < removals.size(); ++i) blocked_in[removals[i].vertex] = level;
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
  for (const std::uint32_t v : top_) keep_ring(v);
}

void HullHierarchy::sort_by_vertex(const std::vector<ShrinkingRings::Removal>& removals) {
  auto& [begin, items] = removed_neighbours_;
  begin.assign(polytope_.vertices.size() + 1, 0);
  items.resize(removals.size());
  for (const auto& removal : removals) ++begin[removal.vertex + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
  for (const auto& removal : removals) {
    items[end[removal.vertex]++] = removal.removed;
    if (growing_rings_.empty()) continue;
    const auto ring = growing_rings_.find(removal.vertex);
    if (ring == growing_rings_.end()) continue;
    ring->second.gaps.push_back({removal.gap_before, removal.gap_behind});
  }
}

HullHierarchy::RingAnswer HullHierarchy::ask_ring(std::uint32_t vertex,
                                                  const GrowingRing& ring,
                                                  const TurningPlane& plane,
                                                  const Vec3& pole,
                                                  HullStatistics& statistics) const {
  const std::vector<Vec3>& vertices = polytope_.vertices;
  const std::span<const std::uint32_t> removed = removed_neighbours_.of(vertex);
  Silhouette silhouette(vertices, pole, vertices[vertex], statistics);
  RingGap before = ring.first.back().gap_behind;
  for (const auto& [neighbour, behind] : ring.first) {
    const int side = plane.side_of(vertices[neighbour], statistics);
    silhouette.start_with({neighbour, before, behind}, side);
    before = behind;
  }
  for (std::int64_t number = silhouette.next(); number >= 0; number = silhouette.next()) {
    const auto n = static_cast<std::size_t>(number);
    const int side = plane.side_of(vertices[removed[n]], statistics);
    if (side > 0) return {.above = removed[n]};
    silhouette.insert(number, {removed[n], ring.gaps[n][0], ring.gaps[n][1]}, side);
  }
  RingAnswer answer;
  if (silhouette.is_in_plane()) answer.in_plane = silhouette.behind() - kWholeGap;
  return answer;
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
    best = v;
    plane = TurningPlane(line, vertices[v]);
  };
  const auto is_above = [&](std::uint32_t v) { return plane.side_of(vertices[v], statistics) > 0; };
  for (const std::uint32_t v : top_) {
    if (is_above(v)) turn_to(v);
  }
  // A removed vertex has only neighbours that were removed at earlier steps, so that its list goes
  // on where the other one is left.
  while (true) {
    std::uint32_t above = kNone;
    const auto ring = growing_rings_.find(best);
    if (ring != growing_rings_.end()) {
      above = ask_ring(best, ring->second, plane, line.a, statistics).above;
    } else {
      const std::span<const std::uint32_t> list = removed_neighbours_.of(best);
      const auto found = std::find_if(list.rbegin(), list.rend(), is_above);
      if (found != list.rend()) above = *found;
    }
    if (above == kNone) return best;
    turn_to(above);
  }
}

/// Calls `is_in_plane` for neighbours of a vertex of the plane, so that all in it are among them;
/// it says whether one is.
template <typename Visit>
void HullHierarchy::visit_neighbours(std::uint32_t vertex,
                                     const TurningPlane& plane,
                                     HullStatistics& statistics,
                                     const Visit& is_in_plane) const {
  const std::span<const std::uint32_t> neighbours = rings_.of(vertex);
  const auto ring = growing_rings_.find(vertex);
  if (ring == growing_rings_.end()) {
    for (const std::uint32_t w : neighbours) is_in_plane(w);
    return;
  }
  // One on the line to a pole is not seen from there; from the other pole it is.
  const auto [pole, other_pole] = plane.poles_for(polytope_.vertices[vertex]);
  RingAnswer answer = ask_ring(vertex, ring->second, plane, pole, statistics);
  if (answer.in_plane == kNone) {
    answer = ask_ring(vertex, ring->second, plane, other_pole, statistics);
  }
  if (answer.in_plane == kNone) return;
  // Those in the plane follow each other, and are not all.
  const std::size_t k = neighbours.size();
  for (std::size_t i = answer.in_plane; is_in_plane(neighbours[i]);) i = (i + 1) % k;
  for (std::size_t i = answer.in_plane; is_in_plane(neighbours[i]);) i = (i + k - 1) % k;
}

void HullHierarchy::add_face(const TurningPlane& plane,
                             std::uint32_t vertex,
                             FaceSearch& search,
                             std::vector<std::uint32_t>& input_indices,
                             HullStatistics& statistics) const {
  // Marks: 2 call for a vertex off the plane, 2 call + 1 in it.
  search.asked_in.resize(std::max(search.asked_in.size(), polytope_.vertices.size()), 0);
  const std::uint32_t off = 2 * ++search.call;
  const auto is_in_plane = [&](std::uint32_t w) {
    std::uint32_t& mark = search.asked_in[w];
    if (mark < off) {
      mark = off;
      if (plane.side_of(polytope_.vertices[w], statistics) == 0) {
        mark = off + 1;
        search.found.push_back(w);
      }
    }
    return mark == off + 1;
  };
  search.found.assign(1, vertex);
  search.asked_in[vertex] = off + 1;
  for (std::size_t i = 0; i < search.found.size(); ++i) {
    const std::uint32_t at = search.found[i];
    input_indices.push_back(polytope_.input_indices[at]);
    visit_neighbours(at, plane, statistics, is_in_plane);
  }
}

}  // namespace carpus::hull
