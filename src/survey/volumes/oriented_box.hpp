// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes along the principal axes of the triangles within, for VolumeTree: OBBTree.
// Source: [gottschalk1996separating].
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "convex/pair_query.hpp"
#include "geometry/mat3.hpp"
#include "survey/volumes/triangle_contact.hpp"

namespace carpus::survey {

struct OrientedBox {
  Mat3 axes;  ///< rows: unit vectors in the body's frame
  Vec3 centre;
  Vec3 half;  ///< along the axes

  struct Motion {
    convex::PairPose pose;
    double slack_mm = 0;
    Motion(const convex::PairPose& first_from_second, double slack)
        : pose(first_from_second), slack_mm(slack) {}
  };
  using Moved = OrientedBox;

  /// Axes are the eigenvectors of the covariance of the triangles' surface (§4; the paper takes the
  /// surface of their convex hull, which for triangles of a convex body is nearly the same).
  [[nodiscard]] static OrientedBox around(std::span<const TrianglePoints> triangles);
  [[nodiscard]] double size() const noexcept { return half.x + half.y + half.z; }

  [[nodiscard]] Moved moved(const Motion& motion) const noexcept {
    OrientedBox box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.axes.rows[i] = motion.pose.rotation * axes.rows[i];
    }
    box.centre = motion.pose.rotation * centre + motion.pose.translation;
    box.half = half;
    return box;
  }
  /// The fifteen axes of §5. Slack is absolute: products of nearly parallel edges prove nothing.
  [[nodiscard]] bool is_apart(const Moved& other, const Motion& motion) const noexcept;
};

}  // namespace carpus::survey
