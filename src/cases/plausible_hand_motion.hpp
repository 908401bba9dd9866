// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a table of hand motion is one that a hand could have: it comes from a file, and a table
// that is right in form can still throw bones across the room.
#pragma once

#include <optional>
#include <string>

#include "cases/hand_motion.hpp"

namespace carpus::cases {

/// Why a wrist cannot move so, in words; nothing where it can. The bounds are far wider than what
/// real and simulated wrists have (hand_motion's own figures stand beside each in the source), but
/// none of them lets a bone jump: while the wrist turns by a milliradian none moves by more than
/// 0.2 mm.
/// @param motion  its numbers finite, its axes rising, its tables full, not empty.
[[nodiscard]] std::optional<std::string> problem_of_motion(const HandMotion& motion);

}  // namespace carpus::cases
