// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/arm_weight.hpp"

#include <cmath>

namespace carpus::arm {
namespace {
constexpr double kGravityNPerGram = 9.80665e-3;
}

LegAngles gravity_torques(const DeltaArm& arm,
                          const LegAngles& angles,
                          const ArmWeight& weight) noexcept {
  const auto state = firmware::delta_forward(arm.size, angles.data());
  LegAngles torques{};
  if (!state.is_valid) return torques;
  firmware::delta_torques(state, {0, 0, weight.tip_g * kGravityNPerGram}, torques.data());
  // Angles are counted downwards: holding a leg up is a negative torque.
  for (std::size_t i = 0; i < 3; ++i) {
    const double lever_mm =
        weight.along_mm * std::cos(angles[i]) + weight.above_mm * std::sin(angles[i]);
    torques[i] -= weight.leg_g * kGravityNPerGram * lever_mm;
  }
  return torques;
}

double cord_torque(const LegCord& cord, double angle) noexcept {
  const double x = cord.pin_mm * std::cos(angle);
  const double z = -cord.pin_mm * std::sin(angle);
  const double length = std::hypot(x - cord.mast_x_mm, z - cord.mast_z_mm);
  if (!(length > cord.slack_mm)) return 0;
  const double tension = cord.tension_n + cord.rate_n_per_mm * (length - cord.slack_mm);
  // (mast - pin) x pin over the length is the lever; d(pin)/d(angle) = (z, -x).
  return tension * ((cord.mast_x_mm - x) * z - (cord.mast_z_mm - z) * x) / length;
}

LegAngles weight_left(const DeltaArm& arm,
                      const LegAngles& angles,
                      const ArmWeight& weight,
                      const LegCord& cord) noexcept {
  LegAngles left = gravity_torques(arm, angles, weight);
  for (std::size_t i = 0; i < 3; ++i) left[i] -= cord_torque(cord, angles[i]);
  return left;
}

Vec3 force_at_tip(const DeltaArm& arm, const LegAngles& angles, const LegAngles& torques) noexcept {
  const auto state = firmware::delta_forward(arm.size, angles.data());
  Vec3 force;
  if (!state.is_valid) return force;
  for (std::size_t i = 0; i < 3; ++i) {
    const firmware::Vector<double>& rod = state.rods[i];
    force += Vec3{rod.x, rod.y, rod.z} * (torques[i] / state.levers[i]);
  }
  return is_finite(force) ? force : Vec3{};
}

}  // namespace carpus::arm
