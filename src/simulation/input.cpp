// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/input.hpp"

#include "simulation/quantisation.hpp"

namespace carpus::simulation {

Input quantised(const Input& input) noexcept {
  Input result = input;
  for (HandInput& hand : result.hands) {
    for (std::size_t i = 0; i < 3; ++i) {
      hand.tip_in_patient[i] = quantised(hand.tip_in_patient[i], kPositionUnitMm);
      hand.shaft_in_patient[i] = quantised(hand.shaft_in_patient[i], kDirectionUnit);
    }
    hand.thrust_n = quantised(hand.thrust_n, kForceUnitN);
  }
  WristPose& wrist = result.wrist;
  wrist.flexion_rad = quantised(wrist.flexion_rad, kAngleUnitRad);
  wrist.radial_deviation_rad = quantised(wrist.radial_deviation_rad, kAngleUnitRad);
  wrist.pronation_rad = quantised(wrist.pronation_rad, kAngleUnitRad);
  wrist.traction_n = quantised(wrist.traction_n, kForceUnitN);
  result.c_arm.rotation_deg = quantised(input.c_arm.rotation_deg, kViewUnitDeg);
  result.c_arm.tilt_deg = quantised(input.c_arm.tilt_deg, kViewUnitDeg);
  result.command.rotation_deg = quantised(input.command.rotation_deg, kViewUnitDeg);
  result.command.tilt_deg = quantised(input.command.tilt_deg, kViewUnitDeg);
  return result;
}

}  // namespace carpus::simulation
