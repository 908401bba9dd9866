// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two convex bodies meet, by exact numbers: the judge of what nothing faster can tell.
#pragma once

#include <array>
#include <cstdint>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// The body { rotation * v + translation }, exactly, for any matrix.
struct PlacedBody {
  const ConvexBody* body = nullptr;
  Mat3 rotation;
  Vec3 translation;
};

/// Where to begin; changes the cost only.
struct ExactHint {
  Vec3 direction{1, 0, 0};  ///< from the first body to the second, finite, in their common frame
  std::uint32_t first_vertex = 0;
  std::uint32_t second_vertex = 0;
  /// Pairs of vertices (of the first, of the second) of the features that seem to touch: a vertex
  /// and a face, or two edges.
  std::array<std::array<std::uint32_t, 2>, 4> seeds{};
  std::uint32_t seed_count = 0;
};

struct ExactAnswer {
  Verdict verdict = Verdict::Unknown;
  std::uint32_t rounds = 0;  ///< pairs of vertices that were asked for; 0: the hint's seeds did
};

/// Is the origin in the set of differences b - a of points of the bodies? The linear program in
/// its vertex form: find n with n . (b - a) > 0 for all vertices, or weights >= 0 of vertices whose
/// differences add up to 0. An active set of at most four vertex pairs, whose nearest point to the
/// origin comes strictly nearer at every round [gilbert1988distance]; with exact numbers nothing
/// can cycle, so it always ends, and the vertices' edges alone find each extreme vertex.
///
/// Unknown only where a number is not finite or larger than kLargestCoordinate in magnitude.
/// Real-time: no allocation. Closed bodies: touching is meeting.
[[nodiscard]] ExactAnswer exactly_meet(const PlacedBody& first,
                                       const PlacedBody& second,
                                       const ExactHint& hint) noexcept;

}  // namespace carpus::convex
