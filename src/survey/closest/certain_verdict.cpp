// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/certain_verdict.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "convex/exact_meeting.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::survey {
namespace {

/// Does the ball of the positions' rounding lie inside the tetrahedron? Then the tetrahedron of the
/// true positions, each within that rounding, holds the origin: its faces cannot have swept over
/// it.
bool holds_ball(const std::array<DifferencePoint, 4>& p, double radius_mm) noexcept {
  constexpr std::array<std::array<std::size_t, 4>, 4> kFaces{
      {{1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 3, 2}, {0, 1, 2, 3}}};
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Vec3 e = p[j].at - p[i].at;
    const Vec3 f = p[k].at - p[i].at;
    const Vec3 n = cross(e, f);
    const Vec3 g = p[opposite].at - p[i].at;
    const double origin = -dot(n, p[i].at);
    const double corner = dot(n, g);
    // Rounding of n, times the lever; for slivers it hides on which side the tetrahedron lies.
    const double rounding = 16 * kRoundoff * length(e) * length(f);
    if (!(std::abs(corner) > rounding * length(g))) return false;
    const double bound = radius_mm * length(n) + rounding * length(p[i].at);  // and the ball
    const bool is_inside = corner > 0 ? origin > bound : -origin > bound;
    if (!is_inside) return false;
  }
  return true;
}

}  // namespace

convex::Verdict certain_verdict(GjkWalk& walk,
                                const PosedPair& pair,
                                const convex::ConvexBody& first,
                                const convex::ConvexBody& second,
                                const convex::PairPose& first_from_second) noexcept {
  if (!pair.is_usable()) return convex::Verdict::Unknown;
  const convex::Verdict verdict = walk.decide(pair);
  if (verdict == convex::Verdict::Apart) return verdict;
  if (verdict == convex::Verdict::Meet && walk.nearest().contains_origin &&
      holds_ball(walk.points(), pair.rounding_mm())) {
    return verdict;
  }
  convex::ExactHint hint;
  hint.direction = normalized_or(walk.nearest().point, normalized_or(pair.offset(), {1, 0, 0}));
  hint.first_vertex = walk.points()[0].first;
  hint.second_vertex = walk.points()[0].second;
  return convex::exactly_meet({&first, Mat3::identity(), {}},
                              {&second, first_from_second.rotation, first_from_second.translation},
                              hint)
      .verdict;
}

}  // namespace carpus::survey
