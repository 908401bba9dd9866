// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/virtual_unit.hpp"

#include "core/units.hpp"

namespace carpus::devices {
namespace {

constexpr double kRadPerUnit = kPi / 8192;

ServoFit fit_of(const firmware::LegConfig& config) {
  ServoFit fit;
  fit.pulse_at_zero_us = config.pulse_at_zero_us;
  fit.pulse_per_half_turn_us = config.pulse_per_turn_us;
  fit.gap_rad = config.gap * kRadPerUnit;
  fit.least_pulse_us = config.least_pulse_us;
  fit.most_pulse_us = config.most_pulse_us;
  return fit;
}

}  // namespace

VirtualUnit::VirtualUnit(firmware::Drive drive, std::uint32_t unit) : unit_(unit) {
  virtual_arm::VirtualArmOptions options;
  options.seed = unit;
  arm_ = drive == firmware::Drive::Motor ? virtual_arm::make_virtual_motor_arm(options)
                                         : virtual_arm::make_virtual_stop_arm(options);
}

ArmCalibration VirtualUnit::calibration() const {
  ArmCalibration calibration;
  calibration.drive = arm_->drive();
  calibration.unit = unit_;
  calibration.made_at = "simulated";
  const firmware::Home home = arm_->home();
  calibration.cogging = arm_->cogging();
  for (std::size_t i = 0; i < kLegs; ++i) {
    if (calibration.drive == firmware::Drive::Stop) {
      calibration.legs[i] = arm_->leg_calibration(static_cast<int>(i));
      calibration.servos[i] = fit_of(arm_->leg_config(static_cast<int>(i)));
    } else {
      const std::int32_t zero = home.zero_counts[i] % kCountsOfTurn;
      calibration.zero_in_turn[i] = zero < 0 ? zero + kCountsOfTurn : zero;
      calibration.windings[i].electrical_zero = home.electrical_zero[i];
      calibration.windings[i].windings = static_cast<firmware::Windings>(home.windings[i]);
    }
  }
  return calibration;
}

}  // namespace carpus::devices
