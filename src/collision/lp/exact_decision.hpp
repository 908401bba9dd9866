// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the linear programs of this folder share: two bodies with their graphs, and the judge for
// poses that doubles cannot tell.
#pragma once

#include "collision/convex_body.hpp"
#include "collision/lp/exact_meeting.hpp"
#include "collision/lp/polar_graph.hpp"
#include "collision/lp/relative_pose.hpp"
#include "collision/pair_query.hpp"

namespace carpus::collision {

struct LpPair {
  const ConvexBody* first = nullptr;
  const ConvexBody* second = nullptr;
  const PolarGraph* a = nullptr;
  const PolarGraph* b = nullptr;
  bool is_usable = false;

  LpPair(const ConvexBody& first_body, const ConvexBody& second_body)
      : first(&first_body),
        second(&second_body),
        a(&first_body.derived<PolarGraph>()),
        b(&second_body.derived<PolarGraph>()),
        is_usable(a->is_usable() && b->is_usable()) {}

  /// False where proofs in doubles are not possible.
  [[nodiscard]] bool place(const PairPose& first_from_second, RelativePose& pose) const noexcept {
    return is_usable && relative_pose(*a, *b, first_from_second, pose);
  }
  [[nodiscard]] ExactAnswer decide_exactly(const PairPose& first_from_second,
                                           const ExactHint& hint) const noexcept {
    return exactly_meet({first, Mat3::identity(), {}},
                        {second, first_from_second.rotation, first_from_second.translation}, hint);
  }
};

}  // namespace carpus::collision
