// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Volume, area and centroid of a hull, however flat, large or small it is.
#pragma once

#include "geometry/convex_polytope.hpp"
#include "geometry/vec3.hpp"

namespace carpus::hull {

struct PolytopeMeasures {
  double volume_mm3 = 0;
  double area_mm2 = 0;
  Vec3 centroid;  ///< of the enclosed volume [mm]; within the polytope but for rounding
};

/// Volume and centroid are summed over the tetrahedra of the facets and one vertex, none of which
/// is negative. Where rounding could be more than 1e-12 of the volume, as in a hull that is flat
/// but for rounding, each is computed exactly first: microseconds a facet. A volume below 1e-308 of
/// the cube of the extent counts as 0, and the centroid then is that of the facets' area.
/// @param polytope  a HullResult's.
[[nodiscard]] PolytopeMeasures measures_of(const ConvexPolytope& polytope);

}  // namespace carpus::hull
