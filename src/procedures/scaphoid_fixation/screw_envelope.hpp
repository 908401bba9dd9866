// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw's envelope on its line, and how far bone covers it (docs/scoring.md).
#pragma once

#include "instruments/instrument.hpp"
#include "instruments/screw_envelope.hpp"
#include "procedure/situation.hpp"
#include "procedures/scaphoid_fixation/outer_bone.hpp"

namespace carpus::procedures::scaphoid_fixation {

using instruments::DeepestPlace;
using instruments::ScrewEnvelope;

/// @param lain  the screw's line.
[[nodiscard]] ScrewEnvelope envelope_of(const procedure::LineFacts& lain);

/// What stands out farthest, rims of its ends included.
[[nodiscard]] DeepestPlace farthest_outside(const OuterBone& bone, const ScrewEnvelope& screw);

/// Least bone beside the screw along the middle of its length [mm], negative where it stands out:
/// how much room the line leaves it. The last `ends_mm` at either end, where every line nears the
/// surface, are not looked at.
[[nodiscard]] double least_bone_beside(const OuterBone& bone,
                                       const ScrewEnvelope& screw,
                                       double ends_mm);

}  // namespace carpus::procedures::scaphoid_fixation
