// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The contract that every hull algorithm of this module fulfils.
#pragma once

#include <cstdint>

#include "geometry/convex_polytope.hpp"

namespace carpus::hull {

/// Why there is no hull, or that there is one.
enum class HullStatus {
  Ok,
  TooFewPoints,  ///< fewer than four points were given
  Collinear,     ///< all points lie on one line, or are one point
  Coplanar,      ///< all points lie in one plane
  NotFinite,     ///< a coordinate is NaN or infinite
  ScaleRange,    ///< a coordinate is beyond kLargestCoordinate or nearer to 0 than
                 ///< kSmallestCoordinate
};

struct HullOptions {
  /// Puts a plane's offset outwards by at most its rounding, so that the facet's own corners
  /// satisfy the row in doubles; others in the same plane do so up to rounding. Off: the offset is
  /// that of the facet's first corner.
  bool planes_contain_vertices = true;
};

/// What a run did; explains why one algorithm wins on some points.
struct HullStatistics {
  std::uint64_t points_discarded = 0;   ///< by a first stage, where the algorithm has one
  std::uint64_t facets_created = 0;     ///< including those removed again; edges in the plane
  std::uint64_t orientation_tests = 0;  ///< on which side of a plane does a point lie?
  std::uint64_t exact_fallbacks = 0;    ///< orientation tests that rounding left open
};

/// Starts in a failed state. With status Ok the polytope is the convex hull of the points as given
/// (doubles, exactly): its vertices are exactly the corners, so no vertex lies on a facet or an
/// edge between others; in the order of the input; facets are triangles (several where corners are
/// coplanar), F = 2V - 4, outward, with neighbours and planes. Otherwise it is empty.
struct HullResult {
  HullStatus status = HullStatus::TooFewPoints;
  ConvexPolytope polytope;
  HullStatistics statistics;
};

}  // namespace carpus::hull
