// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex hull by quickhull, every sign exact.
#pragma once

#include <span>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// Builds the convex hull of a point set. Topology is decided by exact predicates alone, so that
/// coplanar, collinear, cospherical and duplicate points are ordinary input.
///
/// @param points  positions in one frame [mm]; order is irrelevant, duplicates allowed.
/// @return see HullResult. For duplicates, which of them becomes the vertex is not specified.
/// Cost: O(n log n) on average, O(n^2) worst.
/// Sources: [barber1996quickhull], [shewchuk1997predicates].
[[nodiscard]] HullResult build_convex_hull(std::span<const Vec3> points,
                                           const HullOptions& options = {});

}  // namespace carpus::hull
