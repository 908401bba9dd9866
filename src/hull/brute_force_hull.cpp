// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A plane with many points on it turns up for each triple of them; it is taken only for its first
// triple, the one that no earlier point on the plane could replace.
#include "hull/brute_force_hull.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hull/detail/face_polygon.hpp"
#include "hull/detail/finish_hull.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

/// Which points lie where, for the plane through three of them.
struct PlaneSplit {
  bool is_supporting = false;
  int side_of_others = 0;               ///< where all points off the plane are
  std::uint32_t other = 0;              ///< one of them
  std::vector<std::uint32_t> on_plane;  ///< in index order
};

PlaneSplit split_by(std::span<const Vec3> points,
                    std::span<const std::uint32_t> candidates,
                    const std::array<std::uint32_t, 3>& t,
                    HullStatistics& statistics) {
  PlaneSplit split;
  for (const std::uint32_t p : candidates) {
    const int side =
        counted_orient3d(points[t[0]], points[t[1]], points[t[2]], points[p], statistics);
    if (side == 0) {
      split.on_plane.push_back(p);
    } else if (split.side_of_others == 0) {
      split.side_of_others = side;
      split.other = p;
    } else if (side != split.side_of_others) {
      return split;
    }
  }
  split.is_supporting = split.side_of_others != 0;
  return split;
}

/// The first three points of the plane that are not on one line.
bool is_first_triple(std::span<const Vec3> points,
                     std::span<const std::uint32_t> on_plane,
                     const std::array<std::uint32_t, 3>& t) {
  if (t[0] != on_plane[0] || t[1] != on_plane[1]) return false;
  for (std::size_t i = 2; i < on_plane.size(); ++i) {
    if (!are_collinear(points[t[0]], points[t[1]], points[on_plane[i]])) return on_plane[i] == t[2];
  }
  return false;
}

}  // namespace

HullResult build_hull_by_brute_force(std::span<const Vec3> points, const HullOptions& options) {
  HullResult result;
  result.status = find_start_simplex(points, result.statistics).status;
  if (result.status != HullStatus::Ok) return result;
  const std::vector<std::uint32_t> p = distinct_points(points);
  std::vector<Triangle> facets;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      for (std::size_t k = j + 1; k < p.size(); ++k) {
        const std::array<std::uint32_t, 3> triple{p[i], p[j], p[k]};
        if (are_collinear(points[p[i]], points[p[j]], points[p[k]])) continue;
        const PlaneSplit split = split_by(points, p, triple, result.statistics);
        if (!split.is_supporting || !is_first_triple(points, split.on_plane, triple)) continue;
        add_fan(face_polygon(points, split.on_plane, points[split.other], result.statistics),
                facets, result.statistics);
      }
    }
  }
  result.polytope =
      finish_hull(points, std::move(facets), options.planes_contain_vertices, result.statistics);
  return result;
}

}  // namespace carpus::hull
