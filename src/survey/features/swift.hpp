// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// SWIFT: closest features by walks from coarse to fine [ehmann2000accelerated].
#pragma once

#include <memory>

#include "convex/pair_query.hpp"
#include "survey/features/body_levels.hpp"

namespace carpus::survey {

/// Verdict and distance. A query starts from the last one's features on the level where it ended;
/// a walk that takes more than a few steps there (little coherence) is given up for a coarser
/// level, and then taken down again, from level to level along the links of vertices. A verdict
/// needs no descent where the coarse levels meet, or are farther apart than they deviate from the
/// bodies.
///
/// The walk of a level is Lin and Canny's (lin_canny.hpp). Where it goes round on the finest level,
/// Voronoi-Clip (v_clip.hpp) takes over. Bodies nearer than kContactToleranceMm meet.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_swift(const convex::ConvexBody& first,
                                                            const convex::ConvexBody& second);
/// Shares the levels with other pairs.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_swift(
    std::shared_ptr<const BodyLevels> first,
    std::shared_ptr<const BodyLevels> second);

}  // namespace carpus::survey
