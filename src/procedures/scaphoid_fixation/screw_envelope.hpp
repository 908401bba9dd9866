// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw's envelope on its line, and how far bone covers it (docs/scoring.md).
#pragma once

#include "instruments/instrument.hpp"
#include "procedure/situation.hpp"
#include "procedures/scaphoid_fixation/outer_bone.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// A cone between two ends, frame Bone [mm].
struct ScrewEnvelope {
  Vec3 tail;
  Vec3 tip;
  double tail_radius_mm = 0.0;
  double tip_radius_mm = 0.0;
};

/// @param lain  the screw's line.
[[nodiscard]] ScrewEnvelope envelope_of(const procedure::LineFacts& lain);

struct DeepestPlace {
  double outside_mm = 0.0;  ///< 0: nothing stands out
  double along = 0.0;       ///< 0 at the tail, 1 at the tip
  Vec3 point;
};

/// What stands out farthest. The ends are rounded: of them only the middle counts.
[[nodiscard]] DeepestPlace farthest_outside(const OuterBone& bone, const ScrewEnvelope& screw);

/// Least bone beside the screw along the middle of its length [mm], negative where it stands out:
/// how much room the line leaves it. The last `ends_mm` at either end, where every line nears the
/// surface, are not looked at.
[[nodiscard]] double least_bone_beside(const OuterBone& bone,
                                       const ScrewEnvelope& screw,
                                       double ends_mm);

}  // namespace carpus::procedures::scaphoid_fixation
