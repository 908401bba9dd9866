// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Q-COLLIDE: a separating vector, kept from query to query [chung1996quick].
#pragma once

#include <memory>

#include "convex/features/voronoi_features.hpp"
#include "convex/pair_query.hpp"

namespace carpus::survey {

/// Verdict only. Tries the last separating vector: the extreme vertices of both bodies along it,
/// found by climbing from the last ones, tell whether it still separates. If not, their difference
/// d improves it by reflection, s' = s - 2 (s.d) d / |d|^2 [chung1996quick], and so on.
///
/// All differences together bound a cone of vectors that may still separate (separating_cone.hpp).
/// When it becomes empty the bodies meet: four vertex pairs prove it, which are kept and tried
/// first at the next query. A reflection that leaves the cone is replaced by the cone's centre, so
/// that every step cuts the cone: near contact the paper's iteration alone converges slowly. Gaps
/// below kContactToleranceMm count as contact.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_q_collide(const convex::ConvexBody& first,
                                                                const convex::ConvexBody& second);
/// Shares the graphs of features with other pairs.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_q_collide(
    std::shared_ptr<const convex::VoronoiFeatures> first,
    std::shared_ptr<const convex::VoronoiFeatures> second);

}  // namespace carpus::survey
