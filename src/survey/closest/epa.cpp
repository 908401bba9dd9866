// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/epa.hpp"

#include <algorithm>
#include <cmath>

#include "survey/closest/wide_nearest.hpp"

namespace carpus::survey {
namespace {

/// The farther one of the farthest points along d and -d from the plane or line through `origin`.
DifferencePoint farther(const PosedPair& pair,
                        const Vec3& d,
                        const DifferencePoint& origin) noexcept {
  const DifferencePoint p = pair.farthest(d, origin, ClimbStart::Table);
  const DifferencePoint q = pair.farthest(-d, origin, ClimbStart::Table);
  return dot(p.at - origin.at, d) >= dot(origin.at - q.at, d) ? p : q;
}

/// How far weights miss the origin, which they should give [mm].
double error_mm(const std::array<DifferencePoint, 4>& points,
                const SimplexNearest<Vec3>& nearest) noexcept {
  Vec3 sum;
  double weights = -1;
  double reach = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(nearest.weights[i] > 0)) continue;
    sum += points[i].at * nearest.weights[i];
    weights += nearest.weights[i];
    reach = std::max(reach, length(points[i].at));
  }
  return length(sum) + reach * std::abs(weights);
}

}  // namespace

std::array<DifferencePoint, 4> spanning_points(const PosedPair& pair,
                                               const Vec3& direction) noexcept {
  const Vec3 n = normalized_or(direction, {1, 0, 0});
  std::array<DifferencePoint, 4> p;
  p[0] = pair.farthest(n, {}, ClimbStart::Table);
  p[1] = pair.farthest(-n, p[0], ClimbStart::Table);
  const Vec3 line = normalized_or(p[1].at - p[0].at, -n);
  // Across the line: of two directions at right angles, one sees the body's width.
  const Vec3 u = any_perpendicular(line);
  const Vec3 w = cross(line, u);
  const DifferencePoint a = farther(pair, u, p[0]);
  const DifferencePoint b = farther(pair, w, p[0]);
  const bool is_a = length(cross(a.at - p[0].at, line)) >= length(cross(b.at - p[0].at, line));
  p[2] = is_a ? a : b;
  p[3] = farther(pair, normalized_or(cross(line, p[2].at - p[0].at), n), p[0]);
  return p;
}

bool start_polytope(ExpandingPolytope& polytope,
                    const PosedPair& pair,
                    const GjkWalk& walk) noexcept {
  if (walk.count() == 4 && polytope.start(walk.points())) return true;
  return polytope.start(spanning_points(pair, -pair.offset()));
}

convex::Penetration penetration_of(const PosedPair& pair,
                                   const Vec3& normal,
                                   double height_mm,
                                   const std::array<DifferencePoint, 4>& near,
                                   std::size_t near_count) noexcept {
  convex::Penetration result;
  result.depth_mm = height_mm > 0 ? height_mm : 0;
  result.direction = -normal;
  // After the move the foot of the plane is at the origin: there the bodies touch, and the nearest
  // point's weights, begun at the facet, name the points. Where slivers make them poor in doubles,
  // they are computed again in twice the digits.
  const PosedPair touching = pair.moved_by(normal * -height_mm);
  GjkWalk walk(ClimbStart::LastCorner);
  walk.set_points(near, near_count);
  const convex::Verdict verdict = walk.find_nearest(touching, pair.rounding_mm());
  (void)verdict;  // touching within rounding is either one
  convex::Closest touch;
  if (error_mm(walk.points(), walk.nearest()) <= 8 * pair.rounding_mm()) {
    touch = closest_of(pair, walk.points(), walk.nearest());
  } else {
    const WideNearest wide = wide_nearest(touching, near, near_count, pair.rounding_mm());
    touch = closest_of(pair, wide.points, wide.nearest);
  }
  result.on_first = touch.on_first;
  result.on_second = touch.on_second;
  return result;
}

convex::Verdict Epa::meets(const convex::PairPose& first_from_second) noexcept {
  return walk_.decide({first_, second_, first_from_second});
}

std::optional<convex::Penetration> Epa::penetration(
    const convex::PairPose& first_from_second) noexcept {
  const PosedPair pair(first_, second_, first_from_second);
  if (walk_.decide(pair) != convex::Verdict::Meet) return std::nullopt;
  if (!start_polytope(polytope_, pair, walk_)) return std::nullopt;
  while (true) {  // ends: each turn takes a corner, and their number is bounded
    const std::uint16_t t = polytope_.lowest();
    const ExpandingPolytope::Triangle& facet = polytope_.triangle(t);
    const DifferencePoint near = polytope_.corner(facet.corners[0]);
    const DifferencePoint p = pair.farthest(facet.normal, near, ClimbStart::Table);
    const double height = dot(p.at, facet.normal);
    const bool is_done = height - facet.height <= kEpaToleranceMm;
    if (is_done || polytope_.grow(p, t, pair.rounding_mm()) != ExpandingPolytope::Growth::Grown) {
      return penetration_of(pair, facet.normal, height,
                            {polytope_.corner(facet.corners[0]), polytope_.corner(facet.corners[1]),
                             polytope_.corner(facet.corners[2])},
                            3);
    }
  }
}

std::unique_ptr<convex::PairQuery> make_epa(const convex::ConvexBody& first,
                                            const convex::ConvexBody& second) {
  return std::make_unique<Epa>(first, second);
}

}  // namespace carpus::survey
