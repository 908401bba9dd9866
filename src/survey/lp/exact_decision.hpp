// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the linear programs of this folder share: two bodies with their graphs, and the judge for
// poses that doubles cannot tell.
#pragma once

#include "convex/convex_body.hpp"
#include "convex/exact_meeting.hpp"
#include "convex/pair_query.hpp"
#include "convex/polar_graph.hpp"
#include "convex/relative_pose.hpp"

namespace carpus::survey {

struct LpPair {
  const convex::ConvexBody* first = nullptr;
  const convex::ConvexBody* second = nullptr;
  const convex::PolarGraph* a = nullptr;
  const convex::PolarGraph* b = nullptr;
  bool is_usable = false;

  LpPair(const convex::ConvexBody& first_body, const convex::ConvexBody& second_body)
      : first(&first_body),
        second(&second_body),
        a(&first_body.derived<convex::PolarGraph>()),
        b(&second_body.derived<convex::PolarGraph>()),
        is_usable(a->is_usable() && b->is_usable()) {}

  /// False where proofs in doubles are not possible.
  [[nodiscard]] bool place(const convex::PairPose& first_from_second,
                           convex::RelativePose& pose) const noexcept {
    return is_usable && relative_pose(*a, *b, first_from_second, pose);
  }
  [[nodiscard]] convex::ExactAnswer decide_exactly(const convex::PairPose& first_from_second,
                                                   const convex::ExactHint& hint) const noexcept {
    return convex::exactly_meet({first, Mat3::identity(), {}},
                                {second, first_from_second.rotation, first_from_second.translation},
                                hint);
  }
};

}  // namespace carpus::survey
