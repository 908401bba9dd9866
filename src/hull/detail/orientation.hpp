// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The orientation test of geometry/predicates.hpp, counted; and a facet's plane prepared for many
// such tests.
#pragma once

#include <cmath>
#include <cstddef>

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
/// orient3d, evaluated in two steps. Where a, b, c share a coordinate, as points of one voxel slice
/// do, the normal is a unit vector along that axis, the height a difference of two coordinates, its
/// sign certain, and the bound 0.
struct OrientedPlane {
  Vec3 origin;
  Vec3 normal;  ///< cross(b - a, c - a), not normalised
  double bound = 0;

  OrientedPlane() = default;
  [[gnu::always_inline]] inline OrientedPlane(const Vec3& a,
                                              const Vec3& b,
                                              const Vec3& c,
                                              const Vec3& extent)
      : origin(a) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    normal = cross(u, v);
    const Vec3 magnitude{std::abs(u.y * v.z) + std::abs(u.z * v.y),
                         std::abs(u.z * v.x) + std::abs(u.x * v.z),
                         std::abs(u.x * v.y) + std::abs(u.y * v.x)};
    bound = kOrient3dFilter * (dot(magnitude, extent) * (1 + 16 * kRoundoff)) + kUnderflowBound;
    if (((u.x == 0) & (v.x == 0)) | ((u.y == 0) & (v.y == 0)) | ((u.z == 0) & (v.z == 0)))
      make_exact(magnitude);
  }

  /// Proportional to the distance above the plane; its sign is certain beyond +-bound.
  [[nodiscard]] double height(const Vec3& p) const noexcept {
    return normal.x * (p.x - origin.x) + normal.y * (p.y - origin.y) + normal.z * (p.z - origin.z);
  }

 private:
  [[gnu::noinline]] void make_exact(const Vec3& magnitude) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = normal[axis];
      const bool is_alone = normal[(axis + 1) % 3] == 0 && normal[(axis + 2) % 3] == 0;
      if (!is_alone || !(std::abs(along) > kOrient2dFilter * magnitude[axis] + kUnderflowBound))
        continue;
      normal = {0, 0, 0};
      normal[axis] = along > 0 ? 1 : -1;
      bound = 0;
      return;
    }
  }
};

}  // namespace carpus::hull
