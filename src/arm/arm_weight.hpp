// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What of the arm weighs and what carries it. Weights and lengths are those of the drawn parts;
// hardware/workshop holds them to it.
#pragma once

#include "arm/delta_arm.hpp"

namespace carpus::arm {

/// Masses as the three legs carry them.
struct ArmWeight {
  double tip_g = 0;  ///< platform, gimbal and tool with half of the rods
  double leg_g = 0;  ///< an upper arm with the other half of its rods
  /// Of the leg's centre of mass from its axis, in the leg's plane: along it and above it [mm].
  double along_mm = 0;
  double above_mm = 0;
  double leg_inertia_kg_mm2 = 0;  ///< about its axis
};
/// Drive A: the leg with its dog.
inline constexpr ArmWeight kStopArmWeight{113.8, 44.6, 59.6, 0, 202};
/// Drive B: the leg with the capstan's sector, which is a counterweight as well.
inline constexpr ArmWeight kMotorArmWeight{113.8, 52.3, 48.5, 3.3, 213.7};

/// An elastic cord in the leg's plane from a pin on the leg to a mast on its bearing block. Both
/// drives have one on each leg: drive A has nothing else that carries it, and drive B lies lightly
/// in the hand when its motors are off, and spares them four fifths.
struct LegCord {
  double slack_mm = 30;    ///< between the two, where it begins to lengthen
  double tension_n = 1.3;  ///< there
  double rate_n_per_mm = 0.03;
  double pin_mm = 30;     ///< from the leg's axis, along it
  double mast_x_mm = 5;   ///< outwards of the axis
  double mast_z_mm = 58;  ///< above it
};

/// Torques [N mm] that hold the arm's weight up: the change of its potential energy with each
/// angle. Zero where the legs' angles belong to no place.
[[nodiscard]] LegAngles gravity_torques(const DeltaArm& arm,
                                        const LegAngles& angles,
                                        const ArmWeight& weight) noexcept;

/// What a cord gives towards larger angles [N mm]: less than zero where it lifts the leg.
[[nodiscard]] double cord_torque(const LegCord& cord, double angle) noexcept;

/// What is left to hold up [N mm]: the weight less what the cords carry.
[[nodiscard]] LegAngles weight_left(const DeltaArm& arm,
                                    const LegAngles& angles,
                                    const ArmWeight& weight,
                                    const LegCord& cord = {}) noexcept;

/// The force at the tip [N] to which these torques of the legs come, F = sum s_i t_i / (s_i . u_i)
/// (firmware/core/delta.hpp); zero where there is none.
[[nodiscard]] Vec3 force_at_tip(const DeltaArm& arm,
                                const LegAngles& angles,
                                const LegAngles& torques) noexcept;

}  // namespace carpus::arm
