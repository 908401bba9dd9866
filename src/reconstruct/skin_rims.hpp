// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a scan's field cut the skin off: flat outlines, and how far a place is from one that is
// drawn on beyond its plane.
#pragma once

#include <utility>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::reconstruct {

/// A closed outline in a plane, frame of the skin [mm].
struct Rim {
  std::vector<Vec3> corners;
  Vec3 middle;    ///< mean of the corners
  Vec3 outwards;  ///< unit, normal to the plane, away from the skin
  /// Height of a place over the plane [mm].
  [[nodiscard]] double beyond(const Vec3& p) const { return dot(p - middle, outwards); }
};

/// Of an open skin. Left out are rims that no plane cut, as about a corner of the field, and those
/// of less than 150 mm2. @param skin  one piece, consistently oriented
[[nodiscard]] std::vector<Rim> rims_of(const TriangleMesh& skin);

class RimOutline {
 public:
  /// @param rim  must outlive it. @param way  unit, in which the outline is drawn on, not within
  /// the plane.
  RimOutline(const Rim& rim, const Vec3& way);
  /// In the rim's plane, of where a place comes down along the way: negative inside [mm].
  /// @param widened  the outline there against the rim, about its middle [1]
  [[nodiscard]] double distance_to(const Vec3& p, double widened) const;

 private:
  [[nodiscard]] std::pair<double, double> flat(const Vec3& p) const;

  const Rim& rim_;
  Vec3 way_;
  Vec3 across_;
  Vec3 up_;
  std::vector<std::pair<double, double>> flat_;
};

}  // namespace carpus::reconstruct
