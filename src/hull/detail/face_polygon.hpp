// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One face of a hull from the points in its plane, exactly; and the points without duplicates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// Indices of the points, one (the lowest) for each distinct position, ascending. O(n log n).
[[nodiscard]] std::vector<std::uint32_t> distinct_points(std::span<const Vec3> points);

/// Corners of the convex polygon of coplanar points, from the first in lexicographic order
/// counter-clockwise seen from the side of the plane on which `below` is not; points between
/// corners are left out. Andrew's monotone chain [andrew1979another], signs by orient3d against
/// `below`: O(k log k), fewer than 4 k tests.
/// @param on_plane  indices of at least two distinct positions; of duplicates the lowest is taken.
///     If they are collinear the two ends are returned.
[[nodiscard]] std::vector<std::uint32_t> face_polygon(std::span<const Vec3> points,
                                                      std::span<const std::uint32_t> on_plane,
                                                      const Vec3& below,
                                                      HullStatistics& statistics);

/// Adds a fan of the polygon to `facets`.
void add_fan(std::span<const std::uint32_t> polygon,
             std::vector<Triangle>& facets,
             HullStatistics& statistics);

}  // namespace carpus::hull
