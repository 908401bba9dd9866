// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Thrust that a wire needs to go on, from the density along its path; what other instruments need
// is a share of it (Feed, data/instruments.json). No published value for a 1.1 mm wire in the
// scaphoid was found; the law is linear in HU and made to fit what is proposed from drilling
// studies: subchondral entry 15 to 40 N, cancellous 2 to 10 N, far cortex 15 to 30 N [clinical: B11
// E, from S57], at 600 to 1200 HU and 150 to 450 HU [clinical: S55, S56].
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

/// A wire engages where it meets bone at up to 60 degrees from the surface's normal; flatter, the
/// spinning tip walks. The cosine of that angle. Engineering value: surgeons speak of 45 to 60.
inline constexpr double kSkatingCosine = 0.5;
inline constexpr double kSkatingMmPerS = 10.0;

/// Coulomb friction of the resting tip on bone, driver off: a trocar tip bites a little.
inline constexpr double kTipFriction = 0.5;

}  // namespace carpus::instruments
