// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. x_min and x_max; the point farthest from their line; the farthest points above and below the
//    plane of these three, one of which may be missing.
// 2. Every point strictly inside one of the two tetrahedra cannot be a corner and is discarded.
// 3. Gift wrapping of what is left.
// The thesis discards in floating point; here "strictly inside" is exact. "Farthest" is rounded: it
// decides how much is discarded, never the hull.
#include "hull/hybrid_hull.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hull/detail/face_polygon.hpp"
#include "hull/detail/finish_hull.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/detail/orientation.hpp"
#include "hull/detail/wrap.hpp"

namespace carpus::hull {
namespace {

/// Four facets whose inside is below all of them.
using Tetrahedron = std::array<OrientedPlane, 4>;
using Corners = std::array<Vec3, 4>;

/// One tetrahedron of Algorithm 1, with corners ordered so that each facet sees the inside below.
class Filter {
 public:
  /// `d` is below the plane a, b, c.
  Filter(const Corners& corners, const Vec3& extent) : corners_(corners) {
    for (std::size_t f = 0; f < 4; ++f) {
      planes_[f] = OrientedPlane(corner(f, 0), corner(f, 1), corner(f, 2), extent);
    }
  }
  [[nodiscard]] bool holds_strictly(const Vec3& p, HullStatistics& statistics) const {
    for (std::size_t f = 0; f < 4; ++f) {
      ++statistics.orientation_tests;
      const double height = planes_[f].height(p);
      if (height < -planes_[f].bound) continue;
      if (height > planes_[f].bound) return false;
      ++statistics.exact_fallbacks;
      if (orient3d_exact(corner(f, 0), corner(f, 1), corner(f, 2), p) >= 0) return false;
    }
    return true;
  }

 private:
  static constexpr std::array<std::array<std::size_t, 3>, 4> kFacets{
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  [[nodiscard]] const Vec3& corner(std::size_t facet, std::size_t i) const {
    return corners_[kFacets[facet][i]];
  }
  Corners corners_;
  Tetrahedron planes_;
};

/// First point with the largest value.
template <typename Measure>
Vec3 farthest(std::span<const Vec3> points, Measure measure) {
  const Vec3* best = &points[0];
  double best_value = measure(points[0]);
  for (const Vec3& p : points) {
    if (const double value = measure(p); value > best_value) {
      best_value = value;
      best = &p;
    }
  }
  return *best;
}

/// One or two tetrahedra; none where rounding chose points without volume.
std::vector<Filter> double_tetrahedron(std::span<const Vec3> points,
                                       const Vec3& extent,
                                       HullStatistics& statistics) {
  std::vector<Filter> filters;
  const Vec3 a = farthest(points, [](const Vec3& p) { return -p.x; });
  const Vec3 b = farthest(points, [](const Vec3& p) { return p.x; });
  const double size = std::max({extent.x, extent.y, extent.z});
  const Vec3 line = (b - a) / size;
  const Vec3 c =
      farthest(points, [&](const Vec3& p) { return squared_length(cross(line, (p - a) / size)); });
  const Vec3 normal = cross(line, (c - a) / size);
  for (const double sign : {1.0, -1.0}) {
    const Vec3 d =
        farthest(points, [&](const Vec3& p) { return sign * dot(normal, (p - a) / size); });
    const int side = counted_orient3d(a, b, c, d, statistics);
    if (side > 0 && sign > 0) filters.emplace_back(Corners{a, c, b, d}, extent);
    if (side < 0 && sign < 0) filters.emplace_back(Corners{a, b, c, d}, extent);
  }
  return filters;
}

}  // namespace

HullResult build_hull_by_hybrid(std::span<const Vec3> points, const HullOptions& options) {
  HullResult result;
  const StartSimplex start = find_start_simplex(points, result.statistics);
  result.status = start.status;
  if (result.status != HullStatus::Ok) return result;
  const std::vector<Filter> filters = double_tetrahedron(points, start.extent, result.statistics);
  std::vector<std::uint32_t> left = distinct_points(points);
  const auto is_inner = [&](std::uint32_t i) {
    return std::any_of(filters.begin(), filters.end(), [&](const Filter& f) {
      return f.holds_strictly(points[i], result.statistics);
    });
  };
  result.statistics.points_discarded = std::erase_if(left, is_inner);
  result.polytope = finish_hull(points, wrap_hull(points, left, result.statistics),
                                options.planes_contain_vertices, result.statistics);
  return result;
}

}  // namespace carpus::hull
