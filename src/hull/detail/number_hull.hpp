// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From a grown hull to the contract of HullResult: what finish_hull does, where neighbours are
// known and coplanar facets are few.
#pragma once

#include <span>

#include "geometry/convex_polytope.hpp"
#include "hull/detail/hull_facet.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// The same polytope as finish_hull gives for the facets of `hull` that are not removed.
/// O(facets log facets) worst, linear where no vertex has many facets.
[[nodiscard]] ConvexPolytope number_hull(std::span<const Vec3> points,
                                         const GrownHull& hull,
                                         HullStatistics& statistics);

}  // namespace carpus::hull
