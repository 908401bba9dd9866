// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Closest features by a local walk [lin1991incremental], the first method to use that little
// changes from one query to the next.
#pragma once

#include <memory>

#include "convex/features/voronoi_features.hpp"
#include "convex/pair_query.hpp"

namespace carpus::survey {

/// Verdict and distance; starts from the last query's features: takes the nearest points of the
/// pair, and if one lies outside the Voronoi region of the other's feature, moves this feature on
/// across the plane that says so. Each move brings the features nearer as long as the bodies are
/// apart.
///
/// **Fails on overlap**, as the paper says: the walk has no closest features to find. Two of the
/// later remedies are built in: a vertex below its face is followed through the cones from the
/// body's interior point over its faces (the interior regions of [ponamgi1995incremental]), and
/// is inside if it is below the face of its cone; an edge through a face is found on the way. Where
/// the walk ends in neither, it goes round, the cycle is noticed, and the verdict is Unknown:
/// never Apart without a separating plane. Bodies nearer than kContactToleranceMm meet.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_lin_canny(const convex::ConvexBody& first,
                                                                const convex::ConvexBody& second);
/// Shares the graphs of features with other pairs.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_lin_canny(
    std::shared_ptr<const convex::VoronoiFeatures> first,
    std::shared_ptr<const convex::VoronoiFeatures> second);

}  // namespace carpus::survey
