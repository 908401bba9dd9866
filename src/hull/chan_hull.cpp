// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The points are dealt into groups of N. Each group also gets the four points of a start
//    simplex, so that its hull spans space even if all its points lie in one voxel slice.
// 2. Each group's hull is built and stored as a hierarchy (detail/hull_hierarchy.hpp).
// 3. Gift wrapping of the hulls: about each edge each hull says where a plane would touch it, in
//    O(log N); the outermost of these planes is the face, with what every hull has in it.
//    An attempt that must fail is not made: at t = 0 always, at t = 1 where the first and last
//    points along the axes, which are corners, are more than four.
// 4. More than N corners: squared N, and only the corners of the groups' hulls (Chan §4 calls this
//    refinement "pruning"). One group: its hull is the result.
// The thesis, and Chan, use Preparata and Hong's hull in a group; here it is build_fast_hull.
#include "hull/chan_hull.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/check.hpp"
#include "geometry/aabb.hpp"
#include "hull/detail/face_polygon.hpp"
#include "hull/detail/finish_hull.hpp"
#include "hull/detail/hull_hierarchy.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/detail/wrap.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::hull {
namespace {

void add(const HullStatistics& part, HullStatistics& whole) {
  whole.facets_created += part.facets_created;
  whole.orientation_tests += part.orientation_tests;
  whole.exact_fallbacks += part.exact_fallbacks;
}

/// Hull of some of the points; its input_indices name them among all.
HullHierarchy hull_of_group(std::span<const Vec3> points,
                            const std::vector<std::uint32_t>& group,
                            HullStatistics& statistics) {
  std::vector<Vec3> members;
  members.reserve(group.size());
  for (const std::uint32_t i : group) members.push_back(points[i]);
  HullResult hull = build_fast_hull(members);
  CARPUS_CHECK(hull.status == HullStatus::Ok);
  add(hull.statistics, statistics);
  for (std::uint32_t& i : hull.polytope.input_indices) i = group[i];
  return HullHierarchy(std::move(hull.polytope));
}

/// Wraps hulls together until there are more facets than allowed.
class HullWrapper {
 public:
  HullWrapper(std::span<const Vec3> points,
              std::span<const HullHierarchy> hulls,
              const StartSimplex& start,
              HullStatistics& statistics)
      : points_(points), hulls_(hulls), start_(start), statistics_(statistics) {}

  /// Nothing if the hull has more than `most_facets`.
  std::optional<std::vector<Triangle>> run(std::pair<std::uint32_t, std::uint32_t> first,
                                           std::size_t most_facets) {
    open_.push_back(first);
    while (!open_.empty()) {
      const auto [u, v] = open_.back();
      open_.pop_back();
      if (!wrapped_.contains(key(u, v))) wrap(u, v);
      if (facets_.size() > most_facets) return std::nullopt;
    }
    return std::move(facets_);
  }

 private:
  static std::uint64_t key(std::uint32_t u, std::uint32_t v) {
    return static_cast<std::uint64_t>(u) << 32U | v;
  }

  void wrap(std::uint32_t u, std::uint32_t v) {
    const TurningLine line{points_[u], points_[v], start_.extent};
    std::optional<TurningPlane> plane;
    touching_.clear();
    for (std::size_t g = 0; g < hulls_.size(); ++g) {
      const std::uint32_t w = hulls_[g].touch(line, statistics_);
      const Vec3& p = hulls_[g].polytope().vertices[w];
      const int side = plane ? plane->side_of(p, statistics_) : 1;
      if (side < 0) continue;
      if (side > 0) {
        plane.emplace(line, p);
        touching_.clear();
      }
      touching_.push_back({g, w});
    }
    on_plane_.assign({u, v});
    for (const auto& [g, w] : touching_)
      hulls_[g].add_face(*plane, w, face_search_, on_plane_, statistics_);
    std::sort(on_plane_.begin(), on_plane_.end());
    on_plane_.erase(std::unique(on_plane_.begin(), on_plane_.end()), on_plane_.end());
    take(face_polygon(points_, on_plane_, point_below(*plane), statistics_));
  }

  /// The plane holds all points on one side; one of the simplex's corners is off it.
  [[nodiscard]] const Vec3& point_below(const TurningPlane& plane) {
    const auto found =
        std::find_if(start_.corners.begin(), start_.corners.end(),
                     [&](std::uint32_t i) { return plane.side_of(points_[i], statistics_) < 0; });
    CARPUS_CHECK(found != start_.corners.end());
    return points_[*found];
  }

  void take(const std::vector<std::uint32_t>& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t from = polygon[i];
      const std::uint32_t to = polygon[(i + 1) % polygon.size()];
      wrapped_.insert(key(from, to));
      if (!wrapped_.contains(key(to, from))) open_.push_back({to, from});
    }
    add_fan(polygon, facets_, statistics_);
  }

  std::span<const Vec3> points_;
  std::span<const HullHierarchy> hulls_;
  const StartSimplex& start_;
  HullStatistics& statistics_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open_;  ///< directed edges to be wrapped
  std::unordered_set<std::uint64_t> wrapped_;                  ///< only asked, never listed
  std::vector<Triangle> facets_;
  std::vector<std::pair<std::size_t, std::uint32_t>> touching_;  ///< hull, vertex
  FaceSearch face_search_;
  std::vector<std::uint32_t> on_plane_;
};

std::vector<HullHierarchy> hulls_of_groups(std::span<const Vec3> points,
                                           const std::vector<std::uint32_t>& candidates,
                                           const StartSimplex& start,
                                           std::size_t group_size,
                                           HullStatistics& statistics) {
  std::vector<HullHierarchy> hulls;
  std::vector<std::uint32_t> group;
  for (std::size_t begin = 0; begin < candidates.size(); begin += group_size) {
    const auto first = candidates.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto count = std::min(group_size, candidates.size() - begin);
    group.assign(first, first + static_cast<std::ptrdiff_t>(count));
    group.insert(group.end(), start.corners.begin(), start.corners.end());
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
    hulls.push_back(hull_of_group(points, group, statistics));
  }
  return hulls;
}

std::vector<std::uint32_t> corners_of(const std::vector<HullHierarchy>& hulls) {
  std::vector<std::uint32_t> corners;
  for (const HullHierarchy& hull : hulls) {
    const auto& indices = hull.polytope().input_indices;
    corners.insert(corners.end(), indices.begin(), indices.end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// A lower bound on h: the first and the last point in each of three lexicographic orders.
std::size_t count_certain_corners(std::span<const Vec3> points,
                                  const std::vector<std::uint32_t>& candidates) {
  std::set<std::uint32_t> corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto is_before = [&](std::uint32_t i, std::uint32_t j) {
      for (std::size_t k = axis; k < axis + 3; ++k) {
        if (points[i][k % 3] != points[j][k % 3]) return points[i][k % 3] < points[j][k % 3];
      }
      return false;
    };
    const auto [first, last] = std::minmax_element(candidates.begin(), candidates.end(), is_before);
    corners.insert({*first, *last});
  }
  return corners.size();
}

std::vector<Triangle> wrap_groups(std::span<const Vec3> points,
                                  std::vector<std::uint32_t> candidates,
                                  const StartSimplex& start,
                                  HullStatistics& statistics) {
  const auto first = first_hull_edge(points, candidates, statistics);
  const std::size_t distinct = candidates.size();
  for (std::size_t n = count_certain_corners(points, candidates) > 4 ? 16 : 4;; n *= n) {
    const std::vector<HullHierarchy> hulls =
        hulls_of_groups(points, candidates, start, n, statistics);
    candidates = corners_of(hulls);
    statistics.points_discarded = distinct - candidates.size();
    if (hulls.size() == 1) {
      std::vector<Triangle> facets = hulls[0].polytope().facets;
      for (Triangle& t : facets) {
        for (std::uint32_t& v : t) v = hulls[0].polytope().input_indices[v];
      }
      return facets;
    }
    auto facets = HullWrapper(points, hulls, start, statistics).run(first, 2 * n - 4);
    if (facets) return *std::move(facets);
  }
}

}  // namespace

HullResult build_hull_by_chan(std::span<const Vec3> points, const HullOptions& options) {
  HullResult result;
  StartSimplex start = find_start_simplex(points, result.statistics);
  result.status = start.status;
  if (result.status != HullStatus::Ok) return result;
  const std::vector<std::uint32_t> distinct = distinct_points(points);
  for (std::uint32_t& corner : start.corners) {  // of duplicates, the index that `distinct` names
    corner = *std::find_if(distinct.begin(), distinct.end(),
                           [&](std::uint32_t i) { return points[i] == points[corner]; });
  }
  result.polytope = finish_hull(points, wrap_groups(points, distinct, start, result.statistics),
                                options.planes_contain_vertices, result.statistics);
  return result;
}

}  // namespace carpus::hull
