// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gimbal motor of the 2804 class behind a capstan of 10:1, as a leg of drive B has it: a current
// that follows with a delay and weakens with the copper's warmth (its driver sets voltages), a
// limit, cogging; and its encoder of 14 bits.
#pragma once

#include <cstdint>

#include "core/rng.hpp"

namespace carpus::virtual_arm {

struct GimbalMotorKind {
  double ratio = 10;
  double current_s = 0.0004;  ///< time constant
  double peak_n_mm = 940;     ///< at the joint: 2.5 A of 38 mN m/A
  double cogging_n_mm = 1.5;  ///< at the motor
  int cogging_periods = 84;   ///< a turn: 12 slots, 14 poles
  double torque_error = 0.1;  ///< of a specimen's constant: voltage without a current's sensor
  double kelvin_per_watt = 25;
  double heat_s = 100;
  double watts_per_n_mm2 = 1.6 / (280.0 * 280.0);
  double copper_per_kelvin = 0.004;
  int encoder_noise_counts = 1;
};

/// One specimen.
class GimbalMotor {
 public:
  GimbalMotor(const GimbalMotorKind& kind, std::uint64_t seed);
  /// @param wished_n_mm  at the joint. @return what the joint gets [N mm].
  double step(double seconds, double wished_n_mm, double joint_rad) noexcept;
  /// Of the encoder, with its noise.
  [[nodiscard]] std::int32_t counts(double joint_rad) noexcept;
  /// Counts at angle 0 of the leg.
  [[nodiscard]] std::int32_t zero_counts() const noexcept { return zero_counts_; }
  /// As measured: a tenth of its size and a tenth of a radian wrong.
  [[nodiscard]] double measured_cogging_n_mm() const noexcept {
    return 1.1 * kind_.cogging_n_mm * kind_.ratio;
  }
  [[nodiscard]] double measured_phase_rad() const noexcept { return phase_ + 0.1; }
  [[nodiscard]] double celsius() const noexcept { return celsius_; }

 private:
  GimbalMotorKind kind_;
  Rng rng_;
  double constant_;
  double phase_;
  double torque_ = 0;
  double celsius_ = 25;
  std::int32_t zero_counts_;
};

}  // namespace carpus::virtual_arm
