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
    : kind_(kind), rng_(seed), constant_(1), phase_(0), zero_counts_(0) {
  constant_ = 1 + kind.torque_error * rng_.uniform(-1, 1);
  phase_ = rng_.uniform(0, 2 * kPi);
  zero_counts_ = static_cast<std::int32_t>(rng_.below(16384));
}

double GimbalMotor::step(double seconds, double wished_n_mm, double joint_rad) noexcept {
  // Warm copper takes less current from the same voltage.
  const double cold = 1 / (1 + kind_.copper_per_kelvin * (celsius_ - kRoomC));
  const double goal = std::clamp(wished_n_mm * constant_ * cold, -kind_.peak_n_mm, kind_.peak_n_mm);
  torque_ += (goal - torque_) * std::min(1.0, seconds / kind_.current_s);
  const double heat_goal =
      kRoomC + torque_ * torque_ * kind_.watts_per_n_mm2 * kind_.kelvin_per_watt;
  celsius_ += (heat_goal - celsius_) * (seconds / kind_.heat_s);
  const double cogging = kind_.cogging_n_mm * kind_.ratio *
                         std::sin(kind_.cogging_periods * kind_.ratio * joint_rad + phase_);
  return torque_ + cogging;
}

std::int32_t GimbalMotor::counts(double joint_rad) noexcept {
  const double turns = joint_rad / static_cast<double>(firmware::kRadPerCount);
  const auto noise =
      static_cast<std::int32_t>(std::lround(0.4 * kind_.encoder_noise_counts * rng_.normal()));
  return zero_counts_ + static_cast<std::int32_t>(std::floor(turns)) + noise;
}

}  // namespace carpus::virtual_arm
