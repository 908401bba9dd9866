// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_arm/gimbal_motor.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "firmware/core/motor_arm.hpp"

namespace carpus::virtual_arm {
namespace {
constexpr double kRoomC = 25;
}

GimbalMotor::GimbalMotor(const GimbalMotorKind& kind, std::uint64_t seed)
    : kind_(kind), rng_(seed), constant_(1), ohm_(kind.ohm), phase_(0), zero_counts_(0) {
  constant_ = 1 + kind.constant_error * rng_.uniform(-1, 1);
  phase_ = rng_.uniform(0, 2 * kPi);
  zero_counts_ = static_cast<std::int32_t>(rng_.below(16384));
  // A generator of its own: what was drawn before stays as it was.
  Rng assembly(seed ^ 0x77696e64);
  ohm_ *= 1 + kind.ohm_error * assembly.uniform(-1, 1);
  windings_.electrical_zero = static_cast<std::uint16_t>(assembly.below(65536));
  windings_.windings =
      assembly.below(2) == 0 ? firmware::Windings::Along : firmware::Windings::Against;
}

double GimbalMotor::warm_ohm() const noexcept {
  return ohm_ * (1 + kind_.copper_per_kelvin * (celsius_ - kRoomC));
}

double GimbalMotor::step(double seconds,
                         const firmware::WindingVolts& volts,
                         bool is_on,
                         double joint_rad,
                         double joint_rad_per_s) noexcept {
  // Electrical angle of the rotor, without an encoder's steps.
  const double sign = windings_.windings == firmware::Windings::Against ? -1 : 1;
  const double counts = zero_counts_ + joint_rad / static_cast<double>(firmware::kRadPerCount);
  const double rotor =
      2 * kPi / 65536 * (windings_.electrical_zero + sign * counts * firmware::kElectricalPerCount);
  const double u = static_cast<double>(volts.volts[0]);
  const double v = static_cast<double>(volts.volts[1]);
  const double w = static_cast<double>(volts.volts[2]);
  const double alpha = (2 * u - v - w) / 3;
  const double beta = (v - w) / std::sqrt(3.0);
  const double along = alpha * std::cos(rotor) + beta * std::sin(rotor);
  const double across = sign * (beta * std::cos(rotor) - alpha * std::sin(rotor));
  const double ohm = warm_ohm();
  const double constant = constant_ * kind_.n_mm_per_amp;
  const double induced = 1e-3 * constant * kind_.ratio * joint_rad_per_s;
  const double goal = is_on ? (across - induced) / ohm : 0;
  const double along_goal = is_on ? along / ohm : 0;
  const double share = std::min(1.0, seconds / kind_.current_s);
  amps_ += (std::clamp(goal, -kind_.most_amps, kind_.most_amps) - amps_) * share;
  along_amps_ += (std::clamp(along_goal, -kind_.most_amps, kind_.most_amps) - along_amps_) * share;
  const double watts = ohm * (amps_ * amps_ + along_amps_ * along_amps_);
  celsius_ += (kRoomC + watts * kind_.kelvin_per_watt - celsius_) * (seconds / kind_.heat_s);
  const double cogging = kind_.cogging_n_mm * kind_.ratio *
                         std::sin(kind_.cogging_periods * kind_.ratio * joint_rad + phase_);
  return constant * kind_.ratio * amps_ + cogging;
}

std::int32_t GimbalMotor::counts(double joint_rad) noexcept {
  const double turns = joint_rad / static_cast<double>(firmware::kRadPerCount);
  const auto noise =
      static_cast<std::int32_t>(std::lround(0.4 * kind_.encoder_noise_counts * rng_.normal()));
  return zero_counts_ + static_cast<std::int32_t>(std::floor(turns)) + noise;
}

}  // namespace carpus::virtual_arm
