// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Structure's force -> tip with hand -> joints: torques, weight, then friction as an impulse that
// can stop a joint but never turn it round.
#include "virtual_arm/arm_plant.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::virtual_arm {
namespace {
constexpr double kGravityNPerKg = 9.80665;
constexpr double kBeyondRad = 0.07;
}  // namespace

ArmBody body_of(const arm::ArmWeight& weight, double drive_kg_mm2) noexcept {
  ArmBody body;
  body.joint_inertia_kg_mm2 = weight.leg_inertia_kg_mm2 + drive_kg_mm2;
  body.tip_kg = weight.tip_g / 1000;
  const arm::DeltaArm arm;
  body.least_rad = arm.least_angle - kBeyondRad;
  body.most_rad = arm.most_angle + kBeyondRad;
  return body;
}

ArmPlant::ArmPlant(const Linkage& linkage, const ArmBody& body, const JointValues& angles)
    : linkage_(linkage), body_(body), angles_(angles), state_(linkage.at(angles)) {
  tip_ = state_.tip;
  intent_.place = tip_;
  is_sound_ = state_.is_valid;
}

JointValues ArmPlant::weight_to_hold() const noexcept {
  const double left = 1 - body_.balanced_share;
  JointValues hold = linkage_.weight_torques(angles_);
  const JointValues of_tip = torques_of(state_, {0, 0, -body_.tip_kg * kGravityNPerKg});
  for (std::size_t i = 0; i < 3; ++i) hold[i] = -left * (hold[i] + of_tip[i]);
  return hold;
}

void ArmPlant::step(double seconds, const JointValues& torques) noexcept {
  if (!is_sound_) return;
  const Vec3 joint_velocity = velocity_of(state_, rates_);
  const Vec3 structure = (tip_ - state_.tip) * body_.structure_n_per_mm +
                         (tip_velocity_ - joint_velocity) * body_.structure_n_s_per_mm;
  const Vec3 hand = (intent_.place - tip_) * hand_.stiffness_n_per_mm +
                    (intent_.velocity - tip_velocity_) * hand_.damping_n_s_per_mm;
  // The tip's weight acts on the joints, by weight_to_hold below: its balance is there too.
  const Vec3 acceleration = (hand - structure) * (kKilogramMillimeterPerSecond2PerNewton /
                                                  (body_.tip_kg + hand_.mass_kg));
  felt_ = acceleration * (hand_.mass_kg / kKilogramMillimeterPerSecond2PerNewton) - hand;
  const JointValues by_structure = torques_of(state_, structure);
  const JointValues weight = weight_to_hold();
  tip_velocity_ += acceleration * seconds;
  tip_ += tip_velocity_ * seconds;
  for (std::size_t i = 0; i < 3; ++i) {
    const double torque =
        torques[i] + by_structure[i] - weight[i] - body_.joint_viscosity_n_mm_s * rates_[i];
    const double to_rate =
        kKilogramMillimeterPerSecond2PerNewton * seconds / body_.joint_inertia_kg_mm2;
    const double rate = rates_[i] + torque * to_rate;
    const double most = body_.joint_friction_n_mm * to_rate;
    rates_[i] = rate - std::clamp(rate, -most, most);
    const double angle = angles_[i] + rates_[i] * seconds;
    angles_[i] = std::clamp(angle, body_.least_rad, body_.most_rad);
    if (angles_[i] != angle) rates_[i] = 0;
  }
  state_ = linkage_.at(angles_);
  is_sound_ = state_.is_valid && is_finite(tip_) && is_finite(felt_);
}

}  // namespace carpus::virtual_arm
