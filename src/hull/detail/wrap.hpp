// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wrapping itself, over a part of the points; shared by gift wrapping, Chan and the hybrid.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// Closed outward triangulation of the hull of points[candidates], over its corners only.
/// @param candidates  distinct positions that span space.
[[nodiscard]] std::vector<Triangle> wrap_hull(std::span<const Vec3> points,
                                              std::span<const std::uint32_t> candidates,
                                              HullStatistics& statistics);

/// A directed edge of the same hull, where wrapping starts. O(candidates).
[[nodiscard]] std::pair<std::uint32_t, std::uint32_t> first_hull_edge(
    std::span<const Vec3> points,
    std::span<const std::uint32_t> candidates,
    HullStatistics& statistics);

}  // namespace carpus::hull
