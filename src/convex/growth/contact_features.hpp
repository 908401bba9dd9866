// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which features of two bodies all but touch: two edges, or a vertex and a face. A walk in the
// manner of Lin and Canny [lin1991incremental], which takes in one step what costs the dual simplex
// method many pivots: all faces about a vertex at once.
#pragma once

#include <cstdint>

#include "convex/features/feature_pair.hpp"
#include "convex/features/voronoi_features.hpp"
#include "convex/relative_pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

struct ContactEnd {
  enum class Kind : std::uint8_t {
    Apart,    ///< the pair holds the nearest points
    Overlap,  ///< the features have passed each other: `middle` may lie in both bodies
    Open,     ///< the walk became too long
  };
  Kind kind = Kind::Open;
  Vec3 middle;  ///< about the first body's centre, in its frame [mm]
};

/// Walks on from `pair` over a few features. What it finds is where to look for a proof, not one:
/// near overlap it takes the way that is cheap, and where the pose is no rotation but for rounding
/// it may end anywhere. Both centres are the origins that `pose` refers to. Real-time, no
/// allocation.
[[nodiscard]] ContactEnd walk_to_contact(const VoronoiFeatures& first,
                                         const VoronoiFeatures& second,
                                         const RelativePose& pose,
                                         FeaturePair& pair) noexcept;

}  // namespace carpus::convex
