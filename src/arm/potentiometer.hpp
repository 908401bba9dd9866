// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A potentiometer as a voltage divider, and the converter that reads it: the Vishay Spectrol 357 of
// the thesis [yaacoub2008] appendix B.2 (electrical travel 340 +-3 degrees, linearity +-2 %, end
// voltage 0.5 %), one specimen a seed.
#pragma once

#include <array>
#include <cstdint>

#include "core/rng.hpp"

namespace carpus::arm {

/// How far specimens differ; the defaults are the data sheet's and, marked [E], engineering
/// estimates.
struct PotentiometerKind {
  double travel_rad = 5.934;         ///< 340 degrees
  double travel_spread_rad = 0.052;  ///< +-3 degrees
  double linearity = 0.02;           ///< of the travel, at most
  double end_share = 0.005;          ///< of the supply left at either end
  double noise_share = 0.00008;      ///< of the supply, standard deviation: 0.4 mV of 5 V [E]
  double hysteresis_rad = 0.00175;   ///< 0.1 degree [E]
};

/// One specimen. Its total resistance does not matter: supply and converter share one reference.
class Potentiometer {
 public:
  Potentiometer(const PotentiometerKind& kind, std::uint64_t seed);

  /// Share of the supply at the wiper, without noise; at the ends of the track it stays. @param
  /// angle  [rad] from the middle of the track.
  [[nodiscard]] double share_at(double angle) const noexcept;
  /// As a converter meets it now: with hysteresis and noise.
  [[nodiscard]] double read(double angle) noexcept;

 private:
  PotentiometerKind kind_;
  double travel_rad_;
  std::array<double, 3> waves_{};
  std::array<double, 3> phases_{};
  Rng rng_;
  double wiper_ = 0;
  bool has_wiper_ = false;
};

/// Whole counts of a converter of so many bits, over 0 to 1.
[[nodiscard]] std::uint16_t counts_of(double share, int bits) noexcept;

/// The AD512 card of the thesis [yaacoub2008] appendix B.1: 12 bits, one of four ranges, 10 us a
/// conversion, inputs beyond a range read as its end.
enum class CardRange : std::uint8_t { PlusMinus10V, PlusMinus5V, To10V, To5V };
inline constexpr double kCardConversionUs = 10.0;
inline constexpr int kCardChannels = 8;
[[nodiscard]] std::uint16_t card_counts(double volts, CardRange range) noexcept;
/// The voltage in the middle of a count.
[[nodiscard]] double card_volts(std::uint16_t counts, CardRange range) noexcept;

/// A hobby servo's pulse for an angle and back [yaacoub2008] appendix B.3.2: 20 ms frames, 1.5 ms
/// is 90 degrees, 1.0 ms is 0 and 2.0 ms is 180.
inline constexpr double kServoFrameMs = 20.0;
[[nodiscard]] double servo_pulse_ms(double angle_deg) noexcept;
[[nodiscard]] double servo_angle_deg(double pulse_ms) noexcept;

}  // namespace carpus::arm
