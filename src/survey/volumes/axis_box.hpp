// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes along the axes of the body's own frame, for VolumeTree: boxes of one body are all turned
// alike against those of the other. Six axes are tested, those of both boxes: the nine products
// of edges would reject few pairs more [vandenbergen1997efficient] §4.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "convex/pair_query.hpp"
#include "geometry/vec3.hpp"
#include "survey/volumes/triangle_contact.hpp"

namespace carpus::survey {

struct AxisBox {
  Vec3 centre;
  Vec3 half;

  /// What all boxes of the second body share in a query.
  struct Motion {
    convex::PairPose pose;
    Mat3 reach;  ///< |rotation|
    double slack_mm = 0;

    Motion(const convex::PairPose& first_from_second, double slack)
        : pose(first_from_second), slack_mm(slack) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& row = pose.rotation.rows[i];
        reach.rows[i] = {std::abs(row.x), std::abs(row.y), std::abs(row.z)};
      }
    }
  };
  /// A box of the second body in the first one's frame.
  struct Moved {
    Vec3 centre;
    Vec3 half;   ///< along its own axes
    Vec3 reach;  ///< along the first one's, with slack
  };

  [[nodiscard]] static AxisBox around(std::span<const TrianglePoints> triangles);
  [[nodiscard]] double size() const noexcept { return half.x + half.y + half.z; }

  [[nodiscard]] Moved moved(const Motion& motion) const noexcept {
    const Vec3 slack{motion.slack_mm, motion.slack_mm, motion.slack_mm};
    return {motion.pose.rotation * centre + motion.pose.translation, half,
            motion.reach * half + slack};
  }
  [[nodiscard]] bool is_apart(const Moved& other, const Motion& motion) const noexcept {
    const Vec3 d = centre - other.centre;
    if (std::abs(d.x) > half.x + other.reach.x || std::abs(d.y) > half.y + other.reach.y ||
        std::abs(d.z) > half.z + other.reach.z) {
      return true;
    }
    const auto& rows = motion.pose.rotation.rows;
    const auto& reach = motion.reach.rows;
    const Vec3 along = rows[0] * d.x + rows[1] * d.y + rows[2] * d.z;
    const Vec3 mine = reach[0] * half.x + reach[1] * half.y + reach[2] * half.z;
    return std::abs(along.x) > mine.x + other.half.x + motion.slack_mm ||
           std::abs(along.y) > mine.y + other.half.y + motion.slack_mm ||
           std::abs(along.z) > mine.z + other.half.z + motion.slack_mm;
  }
};

}  // namespace carpus::survey
