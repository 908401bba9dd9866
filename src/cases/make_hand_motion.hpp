// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes a wrist's table of hand motion: published carpal kinematics place the bones, and what that
// gets wrong for these bones is corrected so that none passes into another.
#pragma once

#include "cases/case_data.hpp"
#include "cases/hand_motion.hpp"

namespace carpus::cases {

struct HandMotionOptions {
  double step_deg = 10;  ///< widest step of the table's axes
};

/// Makes the table of a wrist as it was scanned. From the scan's own node outwards each node takes
/// over its neighbour's correction and is then relaxed against its bones' distance fields: hand
/// (translation only, so that it is held as asked), scaphoid, lunate and triquetrum each by the
/// least rigid motion that parts them and keeps joints as wide as the scan has them.
///
/// @param data  needs `side`, `wrist_from_patient` and bones with surface and distance field, the
///     capitate among them; `patient_from_bone` is not looked at. Other bones may be missing.
/// @throws InvalidInput without a capitate.
/// Runs through parallel_for, the same bits on any number of threads; a second or two for 16 bones
/// of 3000 vertices on one core.
[[nodiscard]] HandMotion make_hand_motion(const CaseData& data,
                                          const HandMotionOptions& options = {});

/// Makes the table where a case has none, as those of older programs; does nothing otherwise.
void ensure_hand_motion(CaseData& data);

/// Greatest overlap of two bones of different groups with the hand held so, beyond what the scan
/// itself has between the two [mm]; 0 where none overlap.
[[nodiscard]] double overlap_at(const CaseData& data,
                                const HandMotion& motion,
                                const anatomy::HandPose& pose);

}  // namespace carpus::cases
