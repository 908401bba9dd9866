// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Signs of determinants of the coordinates as given, never wrong: a floating-point filter answers
// almost always, exact arithmetic where the filter cannot tell. Coordinates must be finite and at
// most kLargestCoordinate in magnitude. Source: [shewchuk1997predicates].
#pragma once

#include <cmath>

#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

/// A point in the plane [mm].
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
  constexpr bool operator==(const Vec2&) const = default;
};

/// The exact answers without the filter; slow, and the same sign.
[[nodiscard]] int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
[[nodiscard]] int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c);

/// Sign of the determinant where rounding cannot have changed it, else 0: "not known".
[[nodiscard]] inline int orient3d_filter(const Vec3& a,
                                         const Vec3& b,
                                         const Vec3& c,
                                         const Vec3& d) noexcept {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double uyvz = u.y * v.z;
  const double uzvy = u.z * v.y;
  const double uzvx = u.z * v.x;
  const double uxvz = u.x * v.z;
  const double uxvy = u.x * v.y;
  const double uyvx = u.y * v.x;
  const double det = w.x * (uyvz - uzvy) + w.y * (uzvx - uxvz) + w.z * (uxvy - uyvx);
  const double magnitude = (std::abs(uyvz) + std::abs(uzvy)) * std::abs(w.x) +
                           (std::abs(uzvx) + std::abs(uxvz)) * std::abs(w.y) +
                           (std::abs(uxvy) + std::abs(uyvx)) * std::abs(w.z);
  const double bound = kOrient3dFilter * magnitude + kUnderflowBound;
  if (det > bound) return 1;
  return det < -bound ? -1 : 0;
}

/// +1 if d lies on the side of the plane a, b, c to which cross(b - a, c - a) points (from there
/// the triangle is counter-clockwise), -1 on the other, 0 in the plane.
[[nodiscard]] inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign = orient3d_filter(a, b, c, d);
  return sign != 0 ? sign : orient3d_exact(a, b, c, d);
}

/// Sign of the turn where rounding cannot have changed it, else 0: "not known".
[[nodiscard]] inline int orient2d_filter(const Vec2& a, const Vec2& b, const Vec2& c) noexcept {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double det = left - right;
  const double bound = kOrient2dFilter * (std::abs(left) + std::abs(right)) + kUnderflowBound;
  if (det > bound) return 1;
  return det < -bound ? -1 : 0;
}

/// +1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on one line.
[[nodiscard]] inline int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const int sign = orient2d_filter(a, b, c);
  return sign != 0 ? sign : orient2d_exact(a, b, c);
}

/// True if the three points lie on one line (or coincide).
[[nodiscard]] inline bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 &&
         orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

}  // namespace carpus
