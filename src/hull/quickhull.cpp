// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// [barber1996quickhull] with exact signs:
// 1. A tetrahedron of four far-apart points; every other point that lies outside goes to the
//    conflict list of one facet that it sees (is strictly above).
// 2. While a facet has conflicts: its farthest point p; flood the facets that p strictly sees;
// their
//    border is the horizon.
// 3. Replace them by facets from the horizon to p, and hand their conflicts to a new facet that
//    they see; a point that sees none is inside (it sees a new facet if it sees any: the plane of
//    the facet over a horizon edge is a positive combination of the planes on both sides).
// 4. Merge coplanar facets and drop vertices that are no corners (detail/finish_hull.hpp).
// Facets coplanar with p count as not seen; a facet of zero area cannot arise, since p then lies on
// the line of a horizon edge and in the plane of its seen facet. "Farthest" may be rounded.
#include "hull/quickhull.hpp"

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

struct Facet {
  Triangle corners{};
  std::array<std::uint32_t, 3> neighbours{};  ///< across edge (i, i + 1)
  OrientedPlane plane;
  std::uint32_t conflicts = kNone;  ///< first point of the list of those assigned here
  std::uint32_t farthest = kNone;
  double farthest_height = 0;
  std::uint32_t seen_in_round = 0;
  bool is_alive = false;
};

/// An edge of the horizon: from the facet that stays, for the new facet (a, b, p).
struct HorizonEdge {
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t outer;       ///< facet that stays
  std::uint32_t outer_edge;  ///< its edge (b, a)
};

class Quickhull {
 public:
  Quickhull(std::span<const Vec3> points, const StartSimplex& start, HullStatistics& statistics)
      : points_(points),
        extent_(start.extent),
        statistics_(statistics),
        next_conflict_(points.size(), kNone) {
    start_from(start.corners);
  }

  std::vector<Triangle> run() {
    while (!pending_.empty()) {
      const std::uint32_t f = pending_.back();
      pending_.pop_back();
      if (facets_[f].is_alive && facets_[f].conflicts != kNone) add_point(f);
    }
    std::vector<Triangle> result;
    for (const Facet& facet : facets_) {
      if (facet.is_alive) result.push_back(facet.corners);
    }
    return result;
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
    facet = Facet{};
    facet.corners = {a, b, c};
    facet.plane = OrientedPlane(points_[a], points_[b], points_[c], extent_);
    facet.is_alive = true;
    ++statistics_.facets_created;
    return f;
  }

  void start_from(const std::array<std::uint32_t, 4>& s) {
    // s[3] is below (s[0], s[1], s[2]).
    fresh_ = {make_facet(s[0], s[1], s[2]), make_facet(s[0], s[3], s[1]),
              make_facet(s[1], s[3], s[2]), make_facet(s[2], s[3], s[0])};
    facets_[fresh_[0]].neighbours = {fresh_[1], fresh_[2], fresh_[3]};
    facets_[fresh_[1]].neighbours = {fresh_[3], fresh_[2], fresh_[0]};
    facets_[fresh_[2]].neighbours = {fresh_[1], fresh_[3], fresh_[0]};
    facets_[fresh_[3]].neighbours = {fresh_[2], fresh_[1], fresh_[0]};
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (i != s[0] && i != s[1] && i != s[2] && i != s[3]) assign(i);
    }
    pending_.assign(fresh_.begin(), fresh_.end());
  }

  [[nodiscard]] bool sees(const Facet& facet, const Vec3& p) {
    ++statistics_.orientation_tests;
    const double height = facet.plane.height(p);
    if (height > facet.plane.bound) return true;
    if (height < -facet.plane.bound) return false;
    return sees_exactly(facet, p);
  }
  [[nodiscard]] bool sees_exactly(const Facet& facet, const Vec3& p) {
    ++statistics_.exact_fallbacks;
    const Triangle& t = facet.corners;
    return orient3d_exact(points_[t[0]], points_[t[1]], points_[t[2]], p) > 0;
  }

  void attach(std::uint32_t f, std::uint32_t point, double height) {
    Facet& facet = facets_[f];
    next_conflict_[point] = facet.conflicts;
    facet.conflicts = point;
    if (facet.farthest == kNone || height > facet.farthest_height) {
      facet.farthest = point;
      facet.farthest_height = height;
    }
  }

  /// Gives the point to a fresh facet that it sees; certain ones first, they are cheap.
  void assign(std::uint32_t point) {
    const Vec3& p = points_[point];
    doubtful_.clear();
    for (const std::uint32_t f : fresh_) {
      const OrientedPlane& plane = facets_[f].plane;
      const double height = plane.height(p);
      ++statistics_.orientation_tests;
      if (height > plane.bound) {
        attach(f, point, height);
        return;
      }
      if (height >= -plane.bound) doubtful_.push_back(f);
    }
    for (const std::uint32_t f : doubtful_) {
      if (sees_exactly(facets_[f], p)) {
        attach(f, point, facets_[f].plane.height(p));
        return;
      }
    }
  }

  /// Flood from `start`; edges are visited counter-clockwise, so that horizon edges come in order.
  void find_horizon(std::uint32_t start, const Vec3& p) {
    ++round_;
    horizon_.clear();
    seen_.assign(1, start);
    facets_[start].seen_in_round = round_;
    walk_.assign(1, {start, 0, 3});
    while (!walk_.empty()) {
      Visit& visit = walk_.back();
      if (visit.edges_left == 0) {
        walk_.pop_back();
        continue;
      }
      const std::uint32_t f = visit.facet;
      const std::uint32_t edge = visit.edge;
      visit.edge = (edge + 1) % 3;
      --visit.edges_left;
      const std::uint32_t g = facets_[f].neighbours[edge];
      Facet& other = facets_[g];
      if (other.seen_in_round == round_) continue;
      const std::uint32_t back =
          other.neighbours[0] == f ? 0U : (other.neighbours[1] == f ? 1U : 2U);
      if (sees(other, p)) {
        other.seen_in_round = round_;
        seen_.push_back(g);
        walk_.push_back({g, (back + 1) % 3, 2});
      } else {
        const Triangle& t = facets_[f].corners;
        horizon_.push_back({t[edge], t[(edge + 1) % 3], g, back});
      }
    }
  }

  void add_point(std::uint32_t start) {
    const std::uint32_t apex = facets_[start].farthest;
    find_horizon(start, points_[apex]);
    fresh_.clear();
    for (const HorizonEdge& e : horizon_) {
      const std::uint32_t f = make_facet(e.a, e.b, apex);
      facets_[f].neighbours[0] = e.outer;
      facets_[e.outer].neighbours[e.outer_edge] = f;
      fresh_.push_back(f);
    }
    for (std::size_t i = 0; i < fresh_.size(); ++i) {
      const std::size_t next = i + 1 < fresh_.size() ? i + 1 : 0;
      CARPUS_CHECK(horizon_[i].b == horizon_[next].a);  // the horizon is one closed chain
      facets_[fresh_[i]].neighbours[1] = fresh_[next];
      facets_[fresh_[next]].neighbours[2] = fresh_[i];
    }
    for (const std::uint32_t f : seen_) {
      for (std::uint32_t q = facets_[f].conflicts; q != kNone;) {
        const std::uint32_t following = next_conflict_[q];
        if (q != apex) assign(q);
        q = following;
      }
      facets_[f].is_alive = false;
      facets_[f].conflicts = kNone;
    }
    free_.insert(free_.end(), seen_.begin(), seen_.end());
    for (const std::uint32_t f : fresh_) {
      if (facets_[f].conflicts != kNone) pending_.push_back(f);
    }
  }

  struct Visit {
    std::uint32_t facet;
    std::uint32_t edge;
    std::uint32_t edges_left;
  };

  std::span<const Vec3> points_;
  Vec3 extent_;
  HullStatistics& statistics_;
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> pending_;        ///< facets that may have conflicts
  std::vector<std::uint32_t> next_conflict_;  ///< lists through the points
  std::uint32_t round_ = 0;
  // Of the point being added:
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint32_t> fresh_;
  std::vector<std::uint32_t> doubtful_;
  std::vector<HorizonEdge> horizon_;
  std::vector<Visit> walk_;
};

}  // namespace

HullResult build_convex_hull(std::span<const Vec3> points, const HullOptions& options) {
  HullResult result;
  const StartSimplex start = find_start_simplex(points, result.statistics);
  result.status = start.status;
  if (start.status != HullStatus::Ok) return result;
  std::vector<Triangle> facets = Quickhull(points, start, result.statistics).run();
  result.polytope =
      finish_hull(points, std::move(facets), options.planes_contain_vertices, result.statistics);
  return result;
}

}  // namespace carpus::hull
