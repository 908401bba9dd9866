// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Quickhull [barber1996quickhull] as in quickhull.cpp, arranged for the machine:
// 1. Facets are served first in, first out: breadth first, so that far points come early. That
//    creates a third fewer facets than depth first does.
// 2. An adjacency names facet and edge in one word, so that nothing is searched for.
// 3. The points of all facets that a new point removes are gathered once, coordinates apart, and
//    tested facet by facet: loops without branches over consecutive memory.
// 4. Signs come from the filter; the few that it leaves open are kept until the certain ones have
//    placed their points, then decided exactly.
// 5. Where every edge of the result is certainly convex, which the filter shows in one test an
// edge,
//    there is nothing to merge and the facets are numbered directly; else detail/finish_hull.hpp.
#include "hull/fast_hull.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/check.hpp"
#include "hull/detail/finish_hull.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Facet and edge in one word.
constexpr std::uint32_t side(std::uint32_t facet, std::uint32_t edge) { return facet * 4 + edge; }
constexpr std::uint32_t facet_of(std::uint32_t side) { return side / 4; }
constexpr std::uint32_t edge_of(std::uint32_t side) { return side % 4; }
constexpr std::array<std::uint32_t, 3> kNext{1, 2, 0};

struct Facet {
  OrientedPlane plane;
  Triangle corners;
  std::array<std::uint32_t, 3> across;  ///< [edge (i, i + 1)]: side() of the neighbour
  std::uint32_t conflicts;              ///< head of a list through next_conflict_
  std::uint32_t farthest;
  double farthest_height;
  std::uint32_t round;  ///< in which it was last seen; kNone: removed
};

/// Points waiting for a facet, coordinates apart.
struct Batch {
  std::vector<double> x, y, z, height;
  std::vector<std::uint32_t> id;
  std::size_t count = 0;

  explicit Batch(std::size_t capacity)
      : x(capacity), y(capacity), z(capacity), height(capacity), id(capacity) {}
  void push(std::uint32_t point, const Vec3& p) {
    x[count] = p.x;
    y[count] = p.y;
    z[count] = p.z;
    id[count++] = point;
  }
};

void compute_heights(const OrientedPlane& plane, Batch& batch) {
  const auto [nx, ny, nz] = plane.normal;
  const auto [ox, oy, oz] = plane.origin;
  const double* x = batch.x.data();
  const double* y = batch.y.data();
  const double* z = batch.z.data();
  double* height = batch.height.data();
  const std::size_t count = batch.count;
  for (std::size_t i = 0; i < count; ++i) {
    height[i] = nx * (x[i] - ox) + ny * (y[i] - oy) + nz * (z[i] - oz);
  }
}

class FastHull {
 public:
  FastHull(std::span<const Vec3> points, const StartSimplex& start, HullStatistics& statistics)
      : points_(points),
        extent_(start.extent),
        statistics_(statistics),
        next_conflict_(points.size()),
        batch_(points.size()) {
    facets_.reserve(std::min<std::size_t>(3 * points.size() + 4, kReservedFacets));
    start_from(start.corners);
    for (std::size_t head = 0; head < pending_.size(); ++head) {
      const Facet& facet = facets_[pending_[head]];
      if (facet.round != kNone && facet.conflicts != kNone) add_point(pending_[head]);
    }
  }

  [[nodiscard]] ConvexPolytope finish() {
    number_facets();
    return every_edge_is_certainly_convex() ? number_vertices() : merge_and_finish();
  }

 private:
  std::uint32_t make_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t f = 0;
    if (free_.empty()) {
      f = static_cast<std::uint32_t>(facets_.size());
      facets_.emplace_back();
    } else {
      f = free_.back();
      free_.pop_back();
    }
    Facet& facet = facets_[f];
    facet.plane = OrientedPlane(points_[a], points_[b], points_[c], extent_);
    facet.corners = {a, b, c};
    facet.conflicts = kNone;
    facet.farthest = kNone;
    facet.round = 0;
    ++statistics_.facets_created;
    return f;
  }

  void start_from(const std::array<std::uint32_t, 4>& s) {
    // s[3] is below (s[0], s[1], s[2]).
    fresh_ = {make_facet(s[0], s[1], s[2]), make_facet(s[0], s[3], s[1]),
              make_facet(s[1], s[3], s[2]), make_facet(s[2], s[3], s[0])};
    facets_[0].across = {side(1, 2), side(2, 2), side(3, 2)};
    facets_[1].across = {side(3, 1), side(2, 0), side(0, 0)};
    facets_[2].across = {side(1, 1), side(3, 0), side(0, 1)};
    facets_[3].across = {side(2, 1), side(1, 0), side(0, 2)};
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (i != s[0] && i != s[1] && i != s[2] && i != s[3]) batch_.push(i, points_[i]);
    }
    place_batch();
  }

  void attach(std::uint32_t f, std::uint32_t point, double height) {
    Facet& facet = facets_[f];
    next_conflict_[point] = facet.conflicts;
    facet.conflicts = point;
    if (height > facet.farthest_height || facet.farthest == kNone) {
      facet.farthest = point;
      facet.farthest_height = height;
    }
  }

  /// Gives each point of the batch to a fresh facet that it sees; the rest is inside.
  void place_batch() {
    doubtful_.clear();
    for (const std::uint32_t f : fresh_) {
      if (batch_.count == 0) break;
      place_at(f);
    }
    for (const auto& [point, f] : doubtful_) {
      if (next_conflict_[point] != kUnplaced) continue;
      ++statistics_.exact_fallbacks;
      const Triangle& t = facets_[f].corners;
      if (orient3d_exact(points_[t[0]], points_[t[1]], points_[t[2]], points_[point]) > 0)
        attach(f, point, facets_[f].plane.height(points_[point]));
    }
    batch_.count = 0;
    for (const std::uint32_t f : fresh_) {
      if (facets_[f].conflicts != kNone) pending_.push_back(f);
    }
  }

  void place_at(std::uint32_t f) {
    compute_heights(facets_[f].plane, batch_);
    statistics_.orientation_tests += batch_.count;
    const double bound = facets_[f].plane.bound;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < batch_.count; ++i) {
      const double height = batch_.height[i];
      if (!(height < -bound)) {
        if (height > bound) {
          attach(f, batch_.id[i], height);
          continue;
        }
        next_conflict_[batch_.id[i]] = kUnplaced;
        doubtful_.push_back({batch_.id[i], f});
      }
      if (kept != i) {
        batch_.x[kept] = batch_.x[i];
        batch_.y[kept] = batch_.y[i];
        batch_.z[kept] = batch_.z[i];
        batch_.id[kept] = batch_.id[i];
      }
      ++kept;
    }
    batch_.count = kept;
  }

  [[nodiscard]] bool sees(const Facet& facet, const Vec3& p) {
    ++statistics_.orientation_tests;
    const double height = facet.plane.height(p);
    if (height > facet.plane.bound) return true;
    if (height < -facet.plane.bound) return false;
    ++statistics_.exact_fallbacks;
    const Triangle& t = facet.corners;
    return orient3d_exact(points_[t[0]], points_[t[1]], points_[t[2]], p) > 0;
  }

  /// Removes what `p` sees, counter-clockwise from `start`; the horizon's sides come in order.
  void find_horizon(std::uint32_t start, std::uint32_t apex) {
    const Vec3& p = points_[apex];
    horizon_.clear();
    seen_.clear();
    remove(start, apex);
    walk_.assign({side(start, 2), side(start, 1), side(start, 0)});
    while (!walk_.empty()) {
      const std::uint32_t inner = walk_.back();
      walk_.pop_back();
      const std::uint32_t outer = facets_[facet_of(inner)].across[edge_of(inner)];
      const std::uint32_t g = facet_of(outer);
      if (facets_[g].round == kNone) continue;
      if (facets_[g].round != round_ && sees(facets_[g], p)) {
        remove(g, apex);
        const std::uint32_t second = kNext[edge_of(outer)];
        walk_.push_back(side(g, kNext[second]));
        walk_.push_back(side(g, second));
      } else {
        facets_[g].round = round_;  // known not to be seen
        horizon_.push_back({inner, outer});
      }
    }
  }

  void remove(std::uint32_t f, std::uint32_t apex) {
    Facet& facet = facets_[f];
    facet.round = kNone;
    seen_.push_back(f);
    for (std::uint32_t q = facet.conflicts; q != kNone; q = next_conflict_[q]) {
      if (q != apex) batch_.push(q, points_[q]);
    }
    facet.conflicts = kNone;
  }

  void add_point(std::uint32_t start) {
    const std::uint32_t apex = facets_[start].farthest;
    ++round_;
    find_horizon(start, apex);
    fresh_.clear();
    for (const auto& [inner, outer] : horizon_) {
      const Facet& seen = facets_[facet_of(inner)];
      const std::uint32_t e = edge_of(inner);
      const std::uint32_t f = make_facet(seen.corners[e], seen.corners[kNext[e]], apex);
      facets_[f].across[0] = outer;
      facets_[facet_of(outer)].across[edge_of(outer)] = side(f, 0);
      fresh_.push_back(f);
    }
    for (std::size_t i = 0; i < fresh_.size(); ++i) {
      const std::uint32_t f = fresh_[i];
      const std::uint32_t following = fresh_[i + 1 < fresh_.size() ? i + 1 : 0];
      CARPUS_CHECK(facets_[f].corners[1] == facets_[following].corners[0]);  // one closed chain
      facets_[f].across[1] = side(following, 2);
      facets_[following].across[2] = side(f, 1);
    }
    free_.insert(free_.end(), seen_.begin(), seen_.end());
    place_batch();
  }

  /// Moves the facets that remain to the front.
  void number_facets() {
    std::vector<std::uint32_t> number(facets_.size());
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      if (facets_[f].round == kNone) continue;
      number[f] = count;
      if (count != f) facets_[count] = facets_[f];
      ++count;
    }
    facets_.erase(facets_.begin() + count, facets_.end());
    for (Facet& facet : facets_) {
      for (std::uint32_t& s : facet.across) s = side(number[facet_of(s)], edge_of(s));
    }
  }

  [[nodiscard]] bool every_edge_is_certainly_convex() {
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      for (const std::uint32_t s : facets_[f].across) {
        const std::uint32_t g = facet_of(s);
        if (g < f) continue;
        ++statistics_.orientation_tests;
        const std::uint32_t opposite = facets_[g].corners[kNext[kNext[edge_of(s)]]];
        if (!(facets_[f].plane.height(points_[opposite]) < -facets_[f].plane.bound)) return false;
      }
    }
    return true;
  }

  [[nodiscard]] ConvexPolytope merge_and_finish() {
    std::vector<Triangle> triangles;
    triangles.reserve(facets_.size());
    for (const Facet& facet : facets_) triangles.push_back(facet.corners);
    return finish_hull(points_, std::move(triangles), true, statistics_);
  }

  /// The order that finish_hull gives: vertices as in the input, each facet from its lowest vertex,
  /// facets sorted; by counting, since each vertex starts only a few facets.
  [[nodiscard]] ConvexPolytope number_vertices() {
    ConvexPolytope polytope;
    std::vector<std::uint32_t> vertex_of(points_.size(), kNone);
    for (const Facet& facet : facets_) {
      for (const std::uint32_t v : facet.corners) vertex_of[v] = 0;
    }
    polytope.vertices.reserve(facets_.size() / 2 + 2);
    polytope.input_indices.reserve(facets_.size() / 2 + 2);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (vertex_of[i] == kNone) continue;
      vertex_of[i] = static_cast<std::uint32_t>(polytope.vertices.size());
      polytope.vertices.push_back(points_[i]);
      polytope.input_indices.push_back(i);
    }

    // turn[f]: which corner of f is its lowest vertex; place[f]: its position in the result.
    const std::size_t count = facets_.size();
    std::vector<std::uint32_t> begin(polytope.vertices.size() + 1, 0);
    std::vector<std::uint32_t> turn(count);
    for (std::size_t f = 0; f < count; ++f) {
      Triangle& t = facets_[f].corners;
      for (std::uint32_t& v : t) v = vertex_of[v];
      turn[f] = t[0] < t[1] ? (t[0] < t[2] ? 0 : 2) : (t[1] < t[2] ? 1 : 2);
      ++begin[t[turn[f]] + 1];
    }
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<std::uint32_t> order(count);
    std::vector<std::uint32_t> filled(begin.begin(), begin.end() - 1);
    const auto second = [&](std::uint32_t f) { return facets_[f].corners[kNext[turn[f]]]; };
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::uint32_t lowest = facets_[f].corners[turn[f]];
      std::uint32_t at = filled[lowest]++;
      for (; at > begin[lowest] && second(order[at - 1]) > second(f); --at)
        order[at] = order[at - 1];
      order[at] = f;
    }
    std::vector<std::uint32_t> place(count);
    for (std::uint32_t i = 0; i < count; ++i) place[order[i]] = i;

    polytope.facets.resize(count);
    polytope.neighbours.resize(count);
    polytope.planes.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Facet& facet = facets_[order[i]];
      std::uint32_t corner = turn[order[i]];
      for (std::size_t k = 0; k < 3; ++k, corner = kNext[corner]) {
        polytope.facets[i][k] = facet.corners[corner];
        polytope.neighbours[i][k] = place[facet_of(facet.across[corner])];
      }
      const Triangle& t = polytope.facets[i];
      polytope.planes[i] = facet_plane(polytope.vertices[t[0]], polytope.vertices[t[1]],
                                       polytope.vertices[t[2]], true);
    }
    return polytope;
  }

  static constexpr std::uint32_t kUnplaced = kNone - 1;
  /// Facets for which memory is set aside at once. One large block is handed back and forth between
  /// calls by the allocator; growing in steps would touch fresh pages each time, which costs as
  /// much as the hull of a bone.
  static constexpr std::size_t kReservedFacets = 1U << 18U;

  std::span<const Vec3> points_;
  Vec3 extent_;
  HullStatistics& statistics_;
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> free_;           ///< facets to be used again
  std::vector<std::uint32_t> pending_;        ///< facets that may have conflicts, in order of birth
  std::vector<std::uint32_t> next_conflict_;  ///< lists through the points
  std::uint32_t round_ = 0;
  // Of the point being added:
  Batch batch_;
  std::vector<std::uint32_t> fresh_;
  std::vector<std::uint32_t> seen_;                                ///< removed facets
  std::vector<std::pair<std::uint32_t, std::uint32_t>> doubtful_;  ///< point, facet
  std::vector<std::pair<std::uint32_t, std::uint32_t>> horizon_;   ///< inner side, outer side
  std::vector<std::uint32_t> walk_;                                ///< sides to cross
};

}  // namespace

HullResult build_fast_hull(std::span<const Vec3> points) {
  HullResult result;
  const StartSimplex start = find_start_simplex(points, result.statistics);
  result.status = start.status;
  if (start.status != HullStatus::Ok) return result;
  result.polytope = FastHull(points, start, result.statistics).finish();
  return result;
}

}  // namespace carpus::hull
