// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cogging of drive B's motors: a torque that goes up and down with the angle, as often a turn as
// slots and poles have in common. It is most of what a hand feels of the arm in free space, and
// repeats exactly, so that the host takes it off: each leg's amplitude and phase are measured once,
// when the motor holds the leg at a row of angles.
#pragma once

#include <array>

#include "arm/delta_arm.hpp"

namespace carpus::arm {

struct Cogging {
  LegAngles amplitude_n_mm{};  ///< at the leg
  LegAngles phase_rad{};
  double periods_per_turn = 840;  ///< of the leg: 84 of the motor's, ten turns of it
};

/// What the motors do by themselves at these angles [N mm]: their commands get the opposite.
[[nodiscard]] LegAngles cogging_torques(const Cogging& cogging, const LegAngles& angles) noexcept;

/// The force at the tip that takes it off, on average over the time that it will act [N].
/// @param angles, rates  of the legs as last reported [rad], [rad/s].
/// @param ahead_s  from that report until the middle of the time for which the force will act.
[[nodiscard]] Vec3 against_cogging(const DeltaArm& arm,
                                   const Cogging& cogging,
                                   const LegAngles& angles,
                                   const LegAngles& rates,
                                   double ahead_s) noexcept;

}  // namespace carpus::arm
