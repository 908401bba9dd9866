// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The planar algorithms proper, over points that are known to span the plane.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "geometry/predicates.hpp"
#include "hull/detail/orientation.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

using PlanarCorners = std::vector<std::uint32_t>;

/// @param candidates  indices, ascending; not all on one line. Each returns the corners as
///     PlanarHullResult wants them.
[[nodiscard]] PlanarCorners planar_brute_force(std::span<const Vec2> points,
                                               std::span<const std::uint32_t> candidates,
                                               HullStatistics& statistics);
[[nodiscard]] PlanarCorners planar_gift_wrapping(std::span<const Vec2> points,
                                                 std::span<const std::uint32_t> candidates,
                                                 HullStatistics& statistics);
[[nodiscard]] PlanarCorners planar_quickhull(std::span<const Vec2> points,
                                             std::span<const std::uint32_t> candidates,
                                             HullStatistics& statistics);
/// Also of points on one line: its two ends; or of one position.
[[nodiscard]] PlanarCorners planar_graham_scan(std::span<const Vec2> points,
                                               std::span<const std::uint32_t> candidates,
                                               HullStatistics& statistics);

/// The first candidate in (x, y); of its duplicates the first.
[[nodiscard]] std::uint32_t least_point(std::span<const Vec2> points,
                                        std::span<const std::uint32_t> candidates);

/// The candidates without those strictly inside the double triangle of the hybrid.
[[nodiscard]] std::vector<std::uint32_t> outside_double_triangle(
    std::span<const Vec2> points,
    std::span<const std::uint32_t> candidates,
    HullStatistics& statistics);

/// orient2d, counted.
inline int turn(const Vec2& a, const Vec2& b, const Vec2& c, HullStatistics& statistics) {
  ++statistics.orientation_tests;
  const int sign = orient2d_filter(a, b, c);
  if (sign != 0) return sign;
  ++statistics.exact_fallbacks;
  return orient2d_exact(a, b, c);
}

inline bool is_before(const Vec2& a, const Vec2& b) noexcept {
  return std::tie(a.x, a.y) < std::tie(b.x, b.y);
}

/// Of q and s on one ray from p, whether s is farther; compares coordinates, hence exact.
inline bool is_beyond(const Vec2& p, const Vec2& q, const Vec2& s) noexcept {
  if (q.x != p.x) return q.x > p.x ? s.x > q.x : s.x < q.x;
  return q.y > p.y ? s.y > q.y : s.y < q.y;
}

/// Sign of cross(b - a, s - q): whether s is farther to the left of a-b than q. Exact: it is
/// -orient3d of a and b at height 0, q and s at height 1.
inline int compare_heights(const Vec2& a,
                           const Vec2& b,
                           const Vec2& q,
                           const Vec2& s,
                           HullStatistics& statistics) {
  return -counted_orient3d({a.x, a.y, 0}, {b.x, b.y, 0}, {q.x, q.y, 1}, {s.x, s.y, 1}, statistics);
}

}  // namespace carpus::hull
