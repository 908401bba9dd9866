// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the wrist is held for the dorsal approach. In a neutral or extended wrist the dorsal rim of
// the radius lies in the way of a wire along the scaphoid's central axis; surgeons flex the wrist
// by about 45 degrees (docs/scoring.md). First form: the hand, carpus included, is one rigid body
// that stays where it was scanned; the forearm turns about the capitate.
#pragma once

#include "cases/case_data.hpp"

namespace carpus::cases {

/// Room that wire and driver need beside the central axis extended dorsally: half a 12 mm drill
/// guide [mm].
inline constexpr double kDriverClearanceMm = 6.0;
inline constexpr double kPostureStepDeg = 5.0;
inline constexpr double kGreatestFlexionDeg = 60.0;

/// The smallest flexion, in steps of 5 degrees from the scan up to 60, for which the central axis,
/// extended out of the proximal pole, passes radius and ulna at kDriverClearanceMm; where none
/// does, the one that leaves most room. Needs `scaphoid`, `bones` and `wrist_from_patient`.
[[nodiscard]] Posture choose_operative_posture(const CaseData& data);

/// The posture for a given flexion from the scan [rad], positive flexes the hand, on either side.
[[nodiscard]] Posture posture_of_flexion(const CaseData& data, double flexion_rad);

/// Smallest distance [mm] between radius and ulna in this posture and the central axis extended
/// from the proximal pole.
[[nodiscard]] double approach_clearance_mm(const CaseData& data, const Posture& posture);

/// The case with the forearm turned: forearm bones get their pose; CT, labels and skin are
/// resampled into a grid that holds forearm and hand. Bones move rigidly and are neither blurred
/// nor doubled; soft tissue between them bends, by the share of the rotation that its distances to
/// the nearest hand and forearm bones give. `scaphoid` and `wrist_from_patient` stay as scanned.
/// About 1 s for 8 million voxels; loops run through parallel_for.
[[nodiscard]] CaseData apply_posture(CaseData data, const Posture& posture);

}  // namespace carpus::cases
