// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hobby servo of the class of the Futaba FP-S148 [yaacoub2008] appendix B.3: it listens to a
// pulse each 20 ms and turns its horn there with limited torque and speed; a dead band; gears whose
// friction holds the horn when nothing drives it.
#pragma once

#include <cstdint>

namespace carpus::virtual_arm {

/// 4.8 V: 2.4 kg cm, 0.22 s for 60 degrees; the rest estimates for its class.
struct ServoKind {
  double stall_n_mm = 235;
  double fastest_rad_per_s = 4.76;
  double full_error_rad = 0.0698;  ///< 4 degrees beyond the dead band: all it has
  double dead_band_rad = 0.0035;   ///< to each side: 0.2 degrees
  double gear_friction_n_mm = 80;  ///< 50 to 150
  double inertia_kg_mm2 = 1000;    ///< of rotor and gears, at the horn
  double us_per_rad = 1000 / 3.14159265358979;
  double middle_us = 1500;
  double trim_rad = 0.0524;  ///< specimens differ by +-3 degrees
};

/// One specimen.
class HobbyServo {
 public:
  HobbyServo(const ServoKind& kind, std::uint64_t seed);

  /// A pulse has come to its end.
  void pulse(double length_us, double now_us) noexcept;
  /// Its supply. Without, or 40 ms after the last pulse, nothing drives it.
  void set_supply(bool is_on) noexcept { has_supply_ = is_on; }

  /// @param load_n_mm  torque of what the horn meets, on it.
  void step(double seconds, double now_us, double load_n_mm) noexcept;

  [[nodiscard]] double horn_rad() const noexcept { return horn_; }
  [[nodiscard]] double rate_rad_per_s() const noexcept { return rate_; }
  /// Of the motor, at the horn [N mm].
  [[nodiscard]] double driven_n_mm() const noexcept { return driven_; }
  /// The pulse that this specimen answers with this angle.
  [[nodiscard]] double pulse_for(double angle_rad) const noexcept;
  void put(double angle_rad) noexcept {
    horn_ = angle_rad;
    rate_ = 0;
  }

 private:
  ServoKind kind_;
  double trim_rad_;
  double horn_ = 0;
  double rate_ = 0;
  double goal_ = 0;
  double driven_ = 0;
  double heard_us_ = 0;
  bool has_heard_ = false;
  bool has_supply_ = false;
};

}  // namespace carpus::virtual_arm
