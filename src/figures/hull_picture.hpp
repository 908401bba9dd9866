// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of an object and its convex hull, as in figures 4.4 and 4.5 of the thesis [yaacoub2008].
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "geometry/convex_polytope.hpp"
#include "geometry/predicates.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::figures {

/// SVG: the object shaded (or its points, where it has no facets), over it the hull translucent
/// with the edges of its faces; seen without perspective, aslant from the front, right and above.
[[nodiscard]] std::string draw_hull(const TriangleMesh& object, const ConvexPolytope& hull);

/// SVG: points as dots, the hull as a closed line; y up.
[[nodiscard]] std::string draw_planar_hull(std::span<const Vec2> points,
                                           std::span<const std::uint32_t> corners);

}  // namespace carpus::figures
