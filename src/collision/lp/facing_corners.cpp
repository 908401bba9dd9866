// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/lp/facing_corners.hpp"

namespace carpus::collision {

bool FacingCorners::turn(const SupportGraph& first,
                         const SupportGraph& second,
                         const RelativePose& pose,
                         double second_radius_mm,
                         SeparationProof& proof) noexcept {
  SeparationProof turned = proof;
  turned.m = -pose.into_second(turned.n);
  const CertainTop top =
      second.certain_climb(turned.m, has_second_ ? second_ : second.near(turned.m));
  second_ = top.corner;
  has_second_ = true;
  if (!top.is_certain) return false;
  turned.second_reach = top.reach;
  if (!turned.holds(pose, second_radius_mm)) {
    // Sums of rows bound the first body's reach from above only.
    if (has_first_) return false;
    const CertainTop first_top = first.certain_climb(turned.n, first.near(turned.n));
    has_first_ = true;
    if (!first_top.is_certain || !(first_top.reach < turned.first_reach)) return false;
    turned.first_reach = first_top.reach;
    if (!turned.holds(pose, second_radius_mm)) return false;
  }
  proof = turned;
  return true;
}

}  // namespace carpus::collision
