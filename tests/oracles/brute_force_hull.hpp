// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Corners of a convex hull by definition: every plane through three points that has all others on
// one side is a face, and a point is a corner iff three faces with independent normals meet there,
// which is the case iff it is an end of the common line of two faces. O(n^4), exact.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "geometry/predicates.hpp"

namespace carpus::oracles {

/// Positions of the corners (each once), sorted; empty if the points do not span space.
inline std::vector<Vec3> brute_force_corners(std::span<const Vec3> points) {
  // The faces as sets of the points they hold.
  std::set<std::vector<std::size_t>> faces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        if (are_collinear(points[i], points[j], points[k])) continue;
        bool above = false;
        bool below = false;
        std::vector<std::size_t> on;
        for (std::size_t m = 0; m < points.size() && !(above && below); ++m) {
          const int side = orient3d_exact(points[i], points[j], points[k], points[m]);
          above = above || side > 0;
          below = below || side < 0;
          if (side == 0) on.push_back(m);
        }
        if (above != below) faces.insert(on);
      }
    }
  }
  // The meet of all faces through a corner is that corner alone.
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
  };
  std::set<Vec3, decltype(before)> corners(before);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::size_t> meet;
    bool any = false;
    for (const auto& face : faces) {
      const std::set<std::size_t> members(face.begin(), face.end());
      if (!members.contains(i)) continue;
      if (!any) meet = face;
      any = true;
      std::erase_if(meet, [&](std::size_t m) { return !members.contains(m); });
    }
    bool alone = any;
    for (const std::size_t m : meet) alone = alone && points[m] == points[i];
    if (alone) corners.insert(points[i]);
  }
  return {corners.begin(), corners.end()};
}

}  // namespace carpus::oracles
