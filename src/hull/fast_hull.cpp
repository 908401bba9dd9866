// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Quickhull [barber1996quickhull] as in quickhull.cpp, arranged for the machine:
// 1. Many points: the hull of the extremes in fourteen directions comes first, and an ellipsoid in
//    it; what is inside is passed over in one sweep.
// 2. Facets are served first in, first out: breadth first, so that far points come early. That
//    creates a third fewer facets than depth first does. Where points are many, one cell of a grid
//    after another, so that what is at work stays in the caches (detail/facet_queue.hpp).
// 3. Points wait coordinates apart in consecutive memory, and are tested in loops without branches
//    (detail/growing_hull.cpp).
// 4. Signs come from the filter, or from planes in which rounding cannot occur; the few that are
//    left open are decided exactly.
// 5. Only coplanar facets are triangulated anew (detail/whole_faces.cpp), and the result is
//    numbered by counting (detail/number_hull.cpp).
#include "hull/fast_hull.hpp"

#include <cstddef>
#include <vector>

#include "hull/detail/growing_hull.hpp"
#include "hull/detail/input_check.hpp"
#include "hull/detail/number_hull.hpp"

namespace carpus::hull {
namespace {

/// Below this the extremes cost more than the points that they save.
constexpr std::size_t kFewPoints = 1000;

}  // namespace

HullResult build_fast_hull(std::span<const Vec3> points) {
  HullResult result;
  const StartSimplex start = find_start_simplex(points, result.statistics);
  result.status = start.status;
  if (start.status != HullStatus::Ok) return result;
  GrowingHull hull(points, start, result.statistics);
  if (points.size() >= kFewPoints) hull.add(start.extremes);
  hull.add_all();
  result.polytope = number_hull(points, hull.take(), result.statistics);
  return result;
}

}  // namespace carpus::hull
