// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Verdicts by GJK that are never wrong: exact arithmetic where rounding could have decided.
#pragma once

#include "collision/closest/gjk.hpp"
#include "collision/convex_body.hpp"
#include "collision/pair_query.hpp"

namespace carpus::collision {

/// GJK's verdict, warm, if it is proven beyond rounding: a plane with the bodies on its two sides
/// by more than the rounding of a height; or a tetrahedron of the difference whose faces all pass
/// the origin by more than that. Else exactly_meet() decides (slow: bodies that all but
/// touch). Unknown only where the pose is not a number or the scale out of range.
[[nodiscard]] Verdict certain_verdict(GjkWalk& walk,
                                      const PosedPair& pair,
                                      const ConvexBody& first,
                                      const ConvexBody& second,
                                      const PairPose& first_from_second) noexcept;

}  // namespace carpus::collision
