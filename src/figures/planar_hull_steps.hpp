// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How three algorithms come to a convex hull in the plane, step by step, as figures 4.1 to 4.3 of
// the thesis [yaacoub2008] show them. SVG; of points in general position (no three on a line).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geometry/predicates.hpp"

namespace carpus::figures {

/// Gift wrapping [jarvis1973identification]: four moments of its march; from the corner reached the
/// lines to all other points, and the one that leaves all of them to its left.
/// @throws InvalidInput where the points have no hull (as do those below).
[[nodiscard]] std::string draw_gift_wrapping(std::span<const Vec2> points);

/// Quickhull [barber1996quickhull]: the polygon after each round, from the two extreme points; in a
/// round each edge takes up the point farthest beyond it.
[[nodiscard]] std::string draw_quickhull(std::span<const Vec2> points);
/// The rounds' polygons, counter-clockwise, as indices; the last one is the hull.
[[nodiscard]] std::vector<std::vector<std::size_t>> quickhull_rounds(std::span<const Vec2> points);

/// Chan's algorithm [chan1996optimal]: groups of `group` points, each in its hull, and the hull
/// that is wrapped about those.
[[nodiscard]] std::string draw_chan(std::span<const Vec2> points, std::size_t group);

}  // namespace carpus::figures
