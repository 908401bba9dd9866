// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What drive B never exceeds, whatever the host asks: torque of each motor, temperature of its
// windings, velocity of the tip. All torques are scaled alike, so that the force keeps its
// direction.
#pragma once

#include "firmware/core/real.hpp"

namespace carpus {
namespace firmware {

/// A gimbal motor of the 2804 class behind a capstan; the values of one typed set, for review.
struct MotorLimits {
  /// At the joint: 2.5 A of driver, 38 mN m/A, 10:1 [N mm].
  float peak_torque = 940.0F;
  /// Heating: copper loss at 280 N mm is 1.6 W (0.75 A, 2.8 ohm) [W per (N mm)^2].
  float watts_per_torque2 = 1.6F / (280.0F * 280.0F);
  float kelvin_per_watt = 25.0F;
  float time_constant_s = 100.0F;
  float ambient_c = 35.0F;
  /// Torque is taken back from here and is none at the second.
  float warm_c = 80.0F;
  float hot_c = 95.0F;
  /// The tip [mm/s]; a hand in an operation stays below 0.5 m/s.
  float most_speed = 1500.0F;
};

/// Temperatures of three windings, estimated from the torque asked of them.
class ThermalModel {
 public:
  explicit ThermalModel(const MotorLimits& limits) : limits_(limits) {
    for (float& c : celsius_) c = limits.ambient_c;
  }
  void step(const float* torques, float seconds) {
    for (uint8_t i = 0; i < 3; ++i) {
      const float goal = limits_.ambient_c + torques[i] * torques[i] * limits_.watts_per_torque2 *
                                                 limits_.kelvin_per_watt;
      celsius_[i] += (goal - celsius_[i]) * (seconds / limits_.time_constant_s);
    }
  }
  float hottest_c() const {
    float most = celsius_[0];
    for (const float c : celsius_) most = c > most ? c : most;
    return most;
  }
  /// Share of the torque that may be had.
  float share() const {
    return clamped((limits_.hot_c - hottest_c()) / (limits_.hot_c - limits_.warm_c), 0.0F, 1.0F);
  }

 private:
  MotorLimits limits_;
  float celsius_[3];
};

/// Scales torques to the peak of `share`. @return whether anything was taken.
inline bool limit_torques(const MotorLimits& limits, float share, float* torques) {
  const float most = limits.peak_torque * share;
  float largest = 0.0F;
  for (uint8_t i = 0; i < 3; ++i) {
    if (!(absolute(torques[i]) < 1e9F)) {  // not finite: nothing at all
      torques[0] = torques[1] = torques[2] = 0.0F;
      return true;
    }
    if (absolute(torques[i]) > largest) largest = absolute(torques[i]);
  }
  if (!(largest > most)) return false;
  const float scale = most > 0.0F ? most / largest : 0.0F;
  for (uint8_t i = 0; i < 3; ++i) torques[i] *= scale;
  return true;
}

}  // namespace firmware
}  // namespace carpus
