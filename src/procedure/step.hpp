// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of dorsal percutaneous scaphoid fixation, in the order in which the page names them
// (clinical sources: docs/scoring.md). Steps guide; they never forbid: what is possible follows
// from the state of wire and screw, and what was skipped shows in the score.
#pragma once

#include <cstdint>
#include <string_view>

namespace carpus::procedure {

enum class Step : std::uint8_t {
  Survey = 0,   ///< look at the fracture: at least two different views
  Entry = 1,    ///< tip of the guide wire on the proximal pole
  Aim = 2,      ///< shaft along the central axis
  Drive = 3,    ///< drive the wire to the distal subchondral bone
  Check = 4,    ///< views that would show an error, the 45 degree pronated oblique among them
  Measure = 5,  ///< measure the wire's length in the bone
  Choose = 6,   ///< choose a screw
  Insert = 7,   ///< drive the screw until it is buried
  Verify = 8,   ///< final views, then finish
  Finished = 9,
};
inline constexpr int kStepCount = 10;

/// "survey", "entry", …: as in the protocol and in recordings.
[[nodiscard]] std::string_view name_of(Step step) noexcept;

}  // namespace carpus::procedure
