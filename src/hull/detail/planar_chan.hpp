// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Chan's algorithm in the plane [chan1996optimal] §2.
#pragma once

#include <cstdint>
#include <span>

#include "hull/detail/planar_steps.hpp"

namespace carpus::hull {

/// As the algorithms of planar_steps.hpp. Groups of N = min(2^(2^t), n) points are scanned by
/// Graham, then wrapped together with a tangent search of O(log N), until h <= N.
/// O(n log h). statistics.points_discarded counts points inside the hull of their group.
[[nodiscard]] PlanarCorners planar_chan(std::span<const Vec2> points,
                                        std::span<const std::uint32_t> candidates,
                                        HullStatistics& statistics);

/// The vertex of a convex polygon that a ray from `from`, turned clockwise, touches last: no vertex
/// is to the right of from -> it; of two on the ray the farther. `from` is not strictly inside.
/// Over polygons of every 2nd, 4th, 8th ... vertex, as in three dimensions
/// (detail/hull_hierarchy.hpp): the answer stays or becomes one of its two neighbours.
/// @param polygon  strictly convex, counter-clockwise, not only `from` itself.
[[nodiscard]] std::uint32_t right_tangent(std::span<const Vec2> points,
                                          std::span<const std::uint32_t> polygon,
                                          const Vec2& from,
                                          HullStatistics& statistics);

}  // namespace carpus::hull
