// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The orientation test of geometry/predicates.hpp, counted; and a facet's plane prepared for many
// such tests.
#pragma once

#include <cmath>

#include "geometry/predicates.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// orient3d with statistics.
inline int counted_orient3d(const Vec3& a,
                            const Vec3& b,
                            const Vec3& c,
                            const Vec3& d,
                            HullStatistics& statistics) {
  ++statistics.orientation_tests;
  const int sign = orient3d_filter(a, b, c, d);
  if (sign != 0) return sign;
  ++statistics.exact_fallbacks;
  return orient3d_exact(a, b, c, d);
}

/// Plane through a, b, c with a bound on the rounding of `height` that holds for every point whose
/// coordinates differ from a's by at most `extent`. The determinant and its bound are those of
/// orient3d, evaluated in two steps.
struct OrientedPlane {
  Vec3 origin;
  Vec3 normal;  ///< cross(b - a, c - a), not normalised
  double bound = 0;

  OrientedPlane() = default;
  OrientedPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& extent) : origin(a) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    normal = cross(u, v);
    const Vec3 magnitude{std::abs(u.y * v.z) + std::abs(u.z * v.y),
                         std::abs(u.z * v.x) + std::abs(u.x * v.z),
                         std::abs(u.x * v.y) + std::abs(u.y * v.x)};
    bound = kOrient3dFilter * (dot(magnitude, extent) * (1 + 16 * kRoundoff)) + kUnderflowBound;
  }

  /// Proportional to the distance above the plane; its sign is certain beyond +-bound.
  [[nodiscard]] double height(const Vec3& p) const noexcept {
    return normal.x * (p.x - origin.x) + normal.y * (p.y - origin.y) + normal.z * (p.z - origin.z);
  }
};

}  // namespace carpus::hull
