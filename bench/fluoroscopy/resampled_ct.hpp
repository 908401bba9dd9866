// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The oracle: a CT resampled for a pose of hand and forearm, as slow and as plain as can be. Bones
// move rigidly with 1.2 mm around them; soft tissue between turns about the wrist's axis by a share
// of the angle that its distances to hand and forearm bones give.
#pragma once

#include "cases/case_data.hpp"

namespace carpus::bench {

struct WristTurn {
  Vec3 pivot;  ///< Patient [mm]
  Vec3 axis;   ///< unit
  double angle_rad = 0.0;

  /// What radius and ulna do; the hand stays.
  [[nodiscard]] Pose<frame::Patient, frame::Bone> patient_from_forearm() const;
};

/// Flexion of the hand by so much from the scan, about the capitate's head.
[[nodiscard]] WristTurn flexion(const cases::CaseData& data, double flexion_rad);

/// HU on a grid that holds forearm and hand.
[[nodiscard]] Grid<std::int16_t> resampled_ct(const cases::CaseData& data, const WristTurn& turn);

/// 1000 HU where bones of hand and forearm come to lie in the same place, air elsewhere: a rigid
/// hand can be turned so far. The resampled CT holds one of the two there, the composition both.
[[nodiscard]] Grid<std::int16_t> bones_in_one_place(const cases::CaseData& data,
                                                    const WristTurn& turn);

}  // namespace carpus::bench
