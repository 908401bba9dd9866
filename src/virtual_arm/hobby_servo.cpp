// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_arm/hobby_servo.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::virtual_arm {
namespace {
/// Two frames without a pulse, and a servo of this class lets go.
constexpr double kForgetsUs = 40e3;
}  // namespace

HobbyServo::HobbyServo(const ServoKind& kind, std::uint64_t seed) : kind_(kind), trim_rad_(0) {
  Rng rng(seed);
  trim_rad_ = rng.uniform(-1, 1) * kind.trim_rad;
  kind_.gear_friction_n_mm *= rng.uniform(0.8, 1.2);
  kind_.stall_n_mm *= rng.uniform(0.95, 1.05);
}

double HobbyServo::pulse_for(double angle_rad) const noexcept {
  return kind_.middle_us + (angle_rad - trim_rad_) * kind_.us_per_rad;
}

void HobbyServo::pulse(double length_us, double now_us) noexcept {
  goal_ = (length_us - kind_.middle_us) / kind_.us_per_rad + trim_rad_;
  heard_us_ = now_us;
  has_heard_ = true;
}

void HobbyServo::step(double seconds, double now_us, double load_n_mm) noexcept {
  driven_ = 0;
  if (has_supply_ && has_heard_ && now_us - heard_us_ < kForgetsUs) {
    const double error = goal_ - horn_;
    const double beyond = std::abs(error) - kind_.dead_band_rad;
    if (beyond > 0) {
      // The shortest drive that its electronics give just overcomes the gears' friction.
      const double share = std::min(1.0, beyond / kind_.full_error_rad);
      driven_ = std::copysign(kind_.gear_friction_n_mm + share * kind_.stall_n_mm, error);
    }
    driven_ -= (kind_.stall_n_mm + kind_.gear_friction_n_mm) / kind_.fastest_rad_per_s * rate_;
  }
  const double to_rate = kKilogramMillimeterPerSecond2PerNewton * seconds / kind_.inertia_kg_mm2;
  const double rate = rate_ + (driven_ + load_n_mm) * to_rate;
  const double most = kind_.gear_friction_n_mm * to_rate;
  rate_ = rate - std::clamp(rate, -most, most);
  horn_ += rate_ * seconds;
}

}  // namespace carpus::virtual_arm
