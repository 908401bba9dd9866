// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gimbal motor of the 2804 class behind a capstan of 10:1, as a leg of drive B has it: three
// windings that are given voltages, a current that follows with a delay, weakens with the copper's
// warmth and with what the turning rotor induces, a limit, cogging; and its encoder of 14 bits,
// that sits on the shaft as it was put there.
#pragma once

#include <cstdint>

#include "core/rng.hpp"
#include "firmware/core/gimbal_commutation.hpp"

namespace carpus::virtual_arm {

/// The rotor's 5 kg mm2 times the square of the capstan's ratio, on each leg.
inline constexpr double kRotorKgMm2 = 500;

struct GimbalMotorKind {
  double ratio = 10;
  double ohm = 2.8;
  double n_mm_per_amp = 38;   ///< at the motor; as V s/rad a thousandth of it
  double most_amps = 2.5;     ///< of the driver
  double current_s = 0.0004;  ///< time constant
  double cogging_n_mm = 1.5;  ///< at the motor
  int cogging_periods = 84;   ///< a turn: 12 slots, 14 poles
  /// Of a specimen: magnets and supply, which what it induces is beside what is added for it by.
  double constant_error = 0.04;
  /// Windings, plugs, the driver's own: so that a torque is up to an eighth beside what was asked.
  double ohm_error = 0.08;
  double kelvin_per_watt = 25;
  double heat_s = 100;
  double copper_per_kelvin = 0.004;
  int encoder_noise_counts = 1;
};

/// One specimen.
class GimbalMotor {
 public:
  GimbalMotor(const GimbalMotorKind& kind, std::uint64_t seed);
  /// @param volts  of its windings, against their star @param is_on  whether its driver is; off,
  /// its windings are open. @return what the joint gets [N mm].
  double step(double seconds,
              const firmware::WindingVolts& volts,
              bool is_on,
              double joint_rad,
              double joint_rad_per_s) noexcept;
  /// Of the encoder, with its noise.
  [[nodiscard]] std::int32_t counts(double joint_rad) noexcept;
  /// Counts at angle 0 of the leg.
  [[nodiscard]] std::int32_t zero_counts() const noexcept { return zero_counts_; }
  /// How its windings stand to its encoder.
  [[nodiscard]] const firmware::WindingsOf& windings() const noexcept { return windings_; }
  /// As measured: a tenth of its size and a tenth of a radian wrong.
  [[nodiscard]] double measured_cogging_n_mm() const noexcept {
    return 1.1 * kind_.cogging_n_mm * kind_.ratio;
  }
  [[nodiscard]] double measured_phase_rad() const noexcept { return phase_ + 0.1; }
  [[nodiscard]] double celsius() const noexcept { return celsius_; }
  /// What it gives of a torque that is asked, where its windings are held for their data sheet's.
  [[nodiscard]] double share_given() const noexcept { return constant_ * kind_.ohm / warm_ohm(); }

 private:
  [[nodiscard]] double warm_ohm() const noexcept;

  GimbalMotorKind kind_;
  Rng rng_;
  double constant_;
  double ohm_;
  double phase_;
  double amps_ = 0;        ///< across the rotor's field
  double along_amps_ = 0;  ///< along it: heats, and turns nothing
  double celsius_ = 25;
  std::int32_t zero_counts_;
  firmware::WindingsOf windings_;
};

}  // namespace carpus::virtual_arm
