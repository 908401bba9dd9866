// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Verdicts by GJK that are never wrong: exact arithmetic where rounding could have decided.
#pragma once

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "survey/closest/gjk.hpp"

namespace carpus::survey {

/// GJK's verdict, warm, if it is proven beyond rounding: a plane with the bodies on its two sides
/// by more than the rounding of a height; or a tetrahedron of the difference whose faces all pass
/// the origin by more than that. Else exactly_meet() decides (slow: bodies that all but
/// touch). Unknown only where the pose is not a number or the scale out of range.
[[nodiscard]] convex::Verdict certain_verdict(GjkWalk& walk,
                                              const PosedPair& pair,
                                              const convex::ConvexBody& first,
                                              const convex::ConvexBody& second,
                                              const convex::PairPose& first_from_second) noexcept;

}  // namespace carpus::survey
