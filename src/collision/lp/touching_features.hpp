// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two bodies that all but touch, told in twice the digits: most of what doubles cannot tell, at a
// tenth of the cost of exact arithmetic.
#pragma once

#include "collision/lp/exact_meeting.hpp"
#include "collision/pair_query.hpp"

namespace carpus::collision {

/// Looks only at the features that the hint's first three seeds name: a vertex and a face, or two
/// edges. Their plane supports both bodies if no neighbour of its vertices crosses it; then
/// the side of the plane on which the origin of the differences lies tells whether the bodies are
/// apart, and, below the features themselves, that they meet.
///
/// Unknown wherever that is not certain; never wrong: every sign is that of a value larger than
/// the bound of its rounding. Real-time, no allocation.
[[nodiscard]] Verdict touching_features_meet(const PlacedBody& first,
                                             const PlacedBody& second,
                                             const ExactHint& hint) noexcept;

}  // namespace carpus::collision
