// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The first point in lexicographic order is a corner, and the line through it parallel to z
//    touches the hull. A plane turned about that line until it holds all points on one side
//    touches the hull in a face or, more often, an edge.
// 2. About a directed edge (u, v) of the hull a plane is turned in the same way: of all points, the
//    one that has no other above the plane (u, v, w). All points of that plane form the face.
// 3. Each edge of a face is the reversed edge of a neighbour, until every edge has both.
#include "hull/gift_wrapping.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "geometry/aabb.hpp"
#include "hull/detail/face_polygon.hpp"
#include "hull/detail/finish_hull.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/detail/orientation.hpp"
#include "hull/detail/wrap.hpp"

namespace carpus::hull {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A supporting plane and the points in it.
struct Touch {
  std::vector<std::uint32_t> on_plane;
  std::uint32_t below = kNone;  ///< some point off the plane
};

class Wrapper {
 public:
  Wrapper(std::span<const Vec3> points,
          std::span<const std::uint32_t> candidates,
          HullStatistics& statistics)
      : points_(points),
        candidates_(candidates),
        extent_(bounds_of(points).extent() * (1 + 4 * kRoundoff)),
        statistics_(statistics) {}

  /// A directed edge of the hull, with its face to the left.
  std::pair<std::uint32_t, std::uint32_t> first_edge() {
    const std::vector<std::uint32_t> first = first_polygon();
    return {first[0], first[1]};
  }

  std::vector<Triangle> run() {
    open_.push_back(first_edge());
    while (!open_.empty()) {
      const auto [u, v] = open_.back();
      open_.pop_back();
      if (!wrapped_.contains(key(u, v))) wrap(u, v);
    }
    return std::move(facets_);
  }

 private:
  static std::uint64_t key(std::uint32_t u, std::uint32_t v) {
    return static_cast<std::uint64_t>(u) << 32U | v;
  }

  /// orient3d(plane.origin, b, best, p), by the prepared plane where rounding allows.
  int side_of(const OrientedPlane& plane, const Vec3& b, std::uint32_t best, std::uint32_t p) {
    ++statistics_.orientation_tests;
    const double height = plane.height(points_[p]);
    if (height > plane.bound) return 1;
    if (height < -plane.bound) return -1;
    ++statistics_.exact_fallbacks;
    return orient3d_exact(plane.origin, b, points_[best], points_[p]);
  }

  /// Turns a plane about the line a, b, which touches the hull, until no point is above it.
  Touch turn_about(const Vec3& a, const Vec3& b) {
    Touch touch;
    std::uint32_t best = kNone;
    OrientedPlane plane;  // a, b, best
    std::vector<std::uint32_t> on_line;
    for (const std::uint32_t p : candidates_) {
      if (best == kNone) {
        if (are_collinear(a, b, points_[p])) {
          on_line.push_back(p);
        } else {
          best = p;
          plane = OrientedPlane(a, b, points_[best], extent_);
          touch.on_plane.assign(1, p);
        }
        continue;
      }
      const int side = side_of(plane, b, best, p);
      if (side > 0) {
        touch.below = best;
        // What was on the line is still on the plane; what was only on the old plane is below.
        std::erase_if(touch.on_plane,
                      [&](std::uint32_t q) { return !are_collinear(a, b, points_[q]); });
        best = p;
        plane = OrientedPlane(a, b, points_[best], extent_);
        touch.on_plane.push_back(p);
      } else if (side == 0) {
        touch.on_plane.push_back(p);
      } else {
        touch.below = p;
      }
    }
    touch.on_plane.insert(touch.on_plane.end(), on_line.begin(), on_line.end());
    return touch;
  }

  /// A face or an edge of the hull through its first point; two corners that follow each other.
  std::vector<std::uint32_t> first_polygon() {
    const std::uint32_t start = *std::min_element(
        candidates_.begin(), candidates_.end(), [&](std::uint32_t i, std::uint32_t j) {
          const Vec3& a = points_[i];
          const Vec3& b = points_[j];
          return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
    const Vec3 a = points_[start];
    const Vec3 above{a.x, a.y, a.z != 0 ? -a.z : 1.0};  // any other point of the line
    const Touch touch = turn_about(a, above);
    return face_polygon(points_, touch.on_plane, points_[touch.below], statistics_);
  }

  void wrap(std::uint32_t u, std::uint32_t v) {
    const Touch touch = turn_about(points_[u], points_[v]);
    const std::vector<std::uint32_t> polygon =
        face_polygon(points_, touch.on_plane, points_[touch.below], statistics_);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t from = polygon[i];
      const std::uint32_t to = polygon[(i + 1) % polygon.size()];
      wrapped_.insert(key(from, to));
      if (!wrapped_.contains(key(to, from))) open_.push_back({to, from});
    }
    add_fan(polygon, facets_, statistics_);
  }

  std::span<const Vec3> points_;
  std::span<const std::uint32_t> candidates_;
  Vec3 extent_;  ///< bounds every difference of two points
  HullStatistics& statistics_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open_;  ///< directed edges to be wrapped
  std::unordered_set<std::uint64_t> wrapped_;                  ///< only asked, never listed
  std::vector<Triangle> facets_;
};

}  // namespace

std::vector<Triangle> wrap_hull(std::span<const Vec3> points,
                                std::span<const std::uint32_t> candidates,
                                HullStatistics& statistics) {
  return Wrapper(points, candidates, statistics).run();
}

std::pair<std::uint32_t, std::uint32_t> first_hull_edge(std::span<const Vec3> points,
                                                        std::span<const std::uint32_t> candidates,
                                                        HullStatistics& statistics) {
  return Wrapper(points, candidates, statistics).first_edge();
}

HullResult build_hull_by_gift_wrapping(std::span<const Vec3> points, const HullOptions& options) {
  HullResult result;
  result.status = find_start_simplex(points, result.statistics).status;
  if (result.status != HullStatus::Ok) return result;
  result.polytope =
      finish_hull(points, wrap_hull(points, distinct_points(points), result.statistics),
                  options.planes_contain_vertices, result.statistics);
  return result;
}

}  // namespace carpus::hull
