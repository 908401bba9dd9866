// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Voronoi-Clip [mirtich1998vclip]: walks to the closest features by clipping edges to Voronoi
// regions, and finds overlap.
#pragma once

#include <memory>

#include "convex/features/voronoi_features.hpp"
#include "convex/pair_query.hpp"

namespace carpus::survey {

/// Verdict and distance; starts from the last query's features. Overlap is found where an edge
/// goes through a face, or where a vertex is below all faces: a vertex below the face it is nearest
/// to is a local minimum of the walk, from which it escapes to the face that the vertex is highest
/// over (one pass over all faces, [mirtich1998vclip]).
///
/// Bodies nearer than kContactToleranceMm meet. Ties between parallel features, which rounding
/// decides, can make the walk go round. The nearest pair of the cycle then is the answer if
/// climbing to the extreme vertices along its normal proves it; else the walk goes on from these.
/// If that fails from the last features and afresh, the verdict is Unknown (detail/walk.hpp).
///
/// Cost: a step is some 20 to 80 ns; coherent queries take one to three.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_v_clip(const convex::ConvexBody& first,
                                                             const convex::ConvexBody& second);
/// Shares the graphs of features with other pairs.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_v_clip(
    std::shared_ptr<const convex::VoronoiFeatures> first,
    std::shared_ptr<const convex::VoronoiFeatures> second);

}  // namespace carpus::survey
