// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The active set in twice the digits. Corners are still found by walks in doubles: a corner is
// exact, whatever found it; its height is compared with the gap that has to be proven.
#include "survey/closest/wide_nearest.hpp"

#include <cmath>
#include <limits>

#include "convex/double_double.hpp"

namespace carpus::survey {
namespace {

constexpr int kMaxIterations = 64;

convex::DoubleDouble wide_dot(const Vec3& a, const Vec3& b) noexcept {
  return convex::DoubleDouble::product(a.x, b.x) + convex::DoubleDouble::product(a.y, b.y) +
         convex::DoubleDouble::product(a.z, b.z);
}

convex::WideVec3 wide_point(const PosedPair& pair, const DifferencePoint& p) noexcept {
  const Vec3& corner = pair.second().corner(p.second);
  const Mat3& m = pair.rotation();
  const convex::WideVec3 rotated{wide_dot(m.rows[0], corner), wide_dot(m.rows[1], corner),
                                 wide_dot(m.rows[2], corner)};
  return rotated + (convex::WideVec3(pair.offset()) - convex::WideVec3(pair.on_first(p.first)));
}

/// The corners in use, wide.
struct ActiveSet {
  std::array<convex::WideVec3, 4> wide{};
  std::array<DifferencePoint, 4> points{};
  std::size_t count = 0;

  void add(const PosedPair& pair, const DifferencePoint& p) noexcept {
    wide[count] = wide_point(pair, p);
    points[count] = p;
    points[count].at = wide[count].rounded();
    ++count;
  }

  void keep_used(SimplexNearest<convex::WideVec3>& nearest) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if ((nearest.used >> i & 1U) == 0) continue;
      wide[kept] = wide[i];
      points[kept] = points[i];
      nearest.weights[kept] = nearest.weights[i];
      ++kept;
    }
    for (std::size_t i = kept; i < 4; ++i) nearest.weights[i] = 0.0;
    count = kept;
  }
};

WideNearest result_of(convex::Verdict verdict,
                      const ActiveSet& active,
                      const SimplexNearest<convex::WideVec3>& nearest) noexcept {
  WideNearest result;
  result.verdict = verdict;
  result.points = active.points;
  result.count = active.count;
  result.nearest.point = nearest.point.rounded();
  for (std::size_t i = 0; i < 4; ++i) result.nearest.weights[i] = nearest.weights[i].high;
  result.nearest.used = static_cast<std::uint8_t>((1U << active.count) - 1U);
  return result;
}

}  // namespace

WideNearest wide_nearest(const PosedPair& pair,
                         const std::array<DifferencePoint, 4>& points,
                         std::size_t count,
                         double gap_mm) noexcept {
  ActiveSet active;
  for (std::size_t i = 0; i < count; ++i) active.add(pair, points[i]);
  const double rounding = pair.rounding_mm();
  SimplexNearest<convex::WideVec3> nearest;
  convex::DoubleDouble last_squared = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    nearest = nearest_of_simplex(active.wide, active.count);
    if (nearest.contains_origin) return result_of(convex::Verdict::Meet, active, nearest);
    active.keep_used(nearest);
    const convex::DoubleDouble squared = dot(nearest.point, nearest.point);
    const double size = std::sqrt(squared.high);
    if (!(size > rounding)) return result_of(convex::Verdict::Meet, active, nearest);
    const Vec3 v = nearest.point.rounded();
    const DifferencePoint p = pair.farthest(-v, active.points[active.count - 1], ClimbStart::Table);
    if (size - dot(p.at, v) / size <= gap_mm)
      return result_of(convex::Verdict::Apart, active, nearest);
    if (!(squared < last_squared)) break;
    last_squared = squared;
    active.add(pair, p);
  }
  return result_of(convex::Verdict::Unknown, active, nearest);
}

}  // namespace carpus::survey
