// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a closed triangulation of the hull's boundary to the contract of HullResult.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// @param facets  closed, outward triangulation of the hull's boundary over `points`, none of zero
///     area; vertices may lie in the interior of faces and edges of the polytope (algorithms that
///     add points one by one leave such). They are removed: coplanar facets are merged, and each
///     face is triangulated over its corners from the lowest index.
/// @param planes_contain_vertices  see HullOptions.
[[nodiscard]] ConvexPolytope finish_hull(std::span<const Vec3> points,
                                         std::vector<Triangle> facets,
                                         bool planes_contain_vertices,
                                         HullStatistics& statistics);

/// Plane through the corners of a facet, computed on differences scaled by their size; with
/// `contains_corners` its offset is raised by the rounding that it takes for all three to satisfy
/// it.
[[nodiscard]] Plane facet_plane(const Vec3& a, const Vec3& b, const Vec3& c, bool contains_corners);

/// Facet across each edge (i, i + 1) of each facet of a closed, oriented mesh.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> neighbours_of(
    std::span<const Triangle> facets);

}  // namespace carpus::hull
