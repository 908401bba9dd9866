// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two bodies that all but touch, told from the features that do: most of what proofs in doubles
// cannot tell, at a hundredth of the cost of exact arithmetic.
#pragma once

#include "convex/exact_meeting.hpp"
#include "convex/features/feature_pair.hpp"
#include "convex/pair_query.hpp"

namespace carpus::convex {

/// Looks only at two edges, or a vertex and a face. If their plane supports both bodies, the side
/// of it on which the origin of the differences lies tells whether the bodies are apart, and, right
/// below the features themselves, that they meet.
///
/// Unknown wherever that is not certain, and for other features and matrices that are far from a
/// rotation; never wrong: every sign is that of a value larger than the bound of its rounding.
/// Real-time, no allocation.
/// @param pair  features of these bodies, edges with their own faces, as VoronoiFeatures gives
/// them.
[[nodiscard]] Verdict touching_features_meet(const PlacedBody& first,
                                             const PlacedBody& second,
                                             const FeaturePair& pair) noexcept;

}  // namespace carpus::convex
