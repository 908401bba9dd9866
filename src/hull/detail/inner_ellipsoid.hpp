// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An ellipsoid inside a hull, its axes in the proportions of the bounding box: one short formula
// that tells most inner points.
#pragma once

#include "geometry/vec3.hpp"
#include "hull/detail/hull_facet.hpp"

namespace carpus::hull {

class InnerEllipsoid {
 public:
  /// @param extent  of the bounding box of all points [mm].
  InnerEllipsoid(const GrownHull& hull, const Vec3& extent);

  /// True only for points strictly inside the hull.
  [[nodiscard]] bool certainly_contains(const Vec3& p) const noexcept {
    const double x = (p.x - centre_.x) * scale_.x;
    const double y = (p.y - centre_.y) * scale_.y;
    const double z = (p.z - centre_.z) * scale_.z;
    return x * x + y * y + z * z < squared_radius_;
  }

 private:
  Vec3 centre_;
  Vec3 scale_;  ///< 1 over the extent
  double squared_radius_ = 0;
};

}  // namespace carpus::hull
