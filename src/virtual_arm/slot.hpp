// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The slot in the horn in which a leg of drive A moves freely, with pads at its edges; or, with no
// gap, a leg screwed to its horn as the thesis's were.
#pragma once

namespace carpus::virtual_arm {

struct Slot {
  double gap_rad = 0.1571;           ///< from its middle to an edge: 9 degrees
  double pad_n_mm_per_rad = 20'000;  ///< gear and pad: 48 N/mm at the slot's 20 mm
  double pad_n_mm_s_per_rad = 20;    ///< rubber

  /// Torque on the leg; the horn gets the opposite [N mm].
  [[nodiscard]] double torque(double leg, double horn, double leg_rate, double horn_rate) const {
    const double away = leg - horn;
    const double past = away > gap_rad ? away - gap_rad : (away < -gap_rad ? away + gap_rad : 0.0);
    if (past == 0.0 && gap_rad > 0) return 0;
    const double torque = -pad_n_mm_per_rad * past - pad_n_mm_s_per_rad * (leg_rate - horn_rate);
    // A pad pushes and never holds; a screw does both.
    if (gap_rad > 0 && torque * past > 0) return 0;
    return torque;
  }
};

}  // namespace carpus::virtual_arm
