// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Thrust that wire or screw needs to go on, from the density along its path. No published value for
// a 1.1 mm wire in the scaphoid was found; the law is linear in HU and made to fit what is proposed
// from drilling studies: subchondral entry 15 to 40 N, cancellous 2 to 10 N, far cortex 15 to 30 N
// [clinical: B11 E, from S57], at 600 to 1200 HU and 150 to 450 HU [clinical: S55, S56].
#pragma once

#include <algorithm>

namespace carpus::instruments {

/// Resistance [N] of tissue of this density in HU against the spinning wire.
[[nodiscard]] constexpr double wire_resistance_n(double hu) noexcept {
  constexpr double kSoftHu = 150.0;  // gap tissue, muscle, cartilage: nearly free
  constexpr double kSoftN = 0.3;
  constexpr double kCancellousN = 2.0;  // where bone begins
  constexpr double kNewtonPerHu = 0.028;
  constexpr double kGreatestN = 45.0;
  if (!(hu > kSoftHu)) return kSoftN;
  return std::min(kCancellousN + kNewtonPerHu * (hu - kSoftHu), kGreatestN);
}

/// Speed [mm/s] at which the spinning wire advances under this thrust; 0 below the resistance.
[[nodiscard]] constexpr double wire_feed_mm_per_s(double thrust_n, double resistance_n) noexcept {
  constexpr double kMmPerSPerN = 0.4;   // 20 N over the resistance reach the driver's limit
  constexpr double kFastestMmPerS = 8;  // what the tip can clear
  return std::clamp(kMmPerSPerN * (thrust_n - resistance_n), 0.0, kFastestMmPerS);
}

/// Thrust [N] that keeps a self-tapping screw biting; turning, not pushing, does the rest.
[[nodiscard]] constexpr double screw_resistance_n(double hu) noexcept {
  constexpr double kBiteN = 2.0;
  return kBiteN + 0.5 * wire_resistance_n(hu);
}

/// Speed [mm/s] at which the screw goes in: a hand driver's turn or two a second at 1 mm of pitch.
[[nodiscard]] constexpr double screw_feed_mm_per_s(double thrust_n, double resistance_n) noexcept {
  constexpr double kMmPerSPerN = 0.25;
  constexpr double kFastestMmPerS = 2.0;
  return std::clamp(kMmPerSPerN * (thrust_n - resistance_n), 0.0, kFastestMmPerS);
}

inline constexpr double kWithdrawMmPerS = 6.0;   ///< wire, driver in reverse
inline constexpr double kScrewBackMmPerS = 2.0;  ///< screw, driver in reverse

/// A wire engages where it meets bone at up to 60 degrees from the surface's normal; flatter, the
/// spinning tip walks. The cosine of that angle. Engineering value: surgeons speak of 45 to 60.
inline constexpr double kSkatingCosine = 0.5;
inline constexpr double kSkatingMmPerS = 10.0;

/// Coulomb friction of the resting tip on bone, driver off: a trocar tip bites a little.
inline constexpr double kTipFriction = 0.5;

}  // namespace carpus::instruments
