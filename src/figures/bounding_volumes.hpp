// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Kinds of bounding volume about one object, as figure 5.1 of the thesis [yaacoub2008] shows them,
// in the plane of its outline.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/predicates.hpp"

namespace carpus::figures {

struct BoundingShape {
  std::string name;
  std::vector<Vec2> outline;  ///< counter-clockwise; a circle by 180 corners
  double area = 0;
};

/// From the loosest kind to the tightest: the least circle, the box along the axes, the least box
/// of any direction, the octagon of fixed directions (8-DOP), the convex hull.
/// @param points  at least three, not on one line. @throws InvalidInput otherwise.
[[nodiscard]] std::vector<BoundingShape> bounding_shapes(std::span<const Vec2> points);

/// SVG: the points within each, with how much larger than the hull it is.
[[nodiscard]] std::string draw_bounding_volumes(std::span<const Vec2> points);

}  // namespace carpus::figures
