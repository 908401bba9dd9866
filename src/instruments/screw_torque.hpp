// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Torque that a headless screw takes: cutting its thread, in proportion to the bone that it has
// engaged, and drawing the pieces together, as any screw does (T = k d F, k = 0.2 [K]). No
// published torque of a scaphoid screw was found: the first part is set so that 20 mm in cancellous
// bone of 300 HU take 50 N mm and the peak before stripping lies near 150 [E].
#pragma once

#include <algorithm>

namespace carpus::instruments {

struct Threading {
  double engaged_mm = 0.0;  ///< of its length in bone
  double mean_hu = 0.0;     ///< of the bone around it
  double diameter_mm = 0.0;
  double compression_n = 0.0;  ///< of what it holds
  bool is_stripped = false;
};

/// Of the torque, to turn it back [K].
inline constexpr double kLooseningShare = 0.8;

[[nodiscard]] constexpr double screw_torque_n_mm(const Threading& screw) noexcept {
  constexpr double kPerMmAndHu = 0.0083;   // [E]
  constexpr double kNutFactor = 0.2;       // [K]
  constexpr double kStrippedShare = 0.25;  // bone that was sheared still rubs [E]
  const double bone = std::max(0.0, screw.mean_hu);
  const double cutting = kPerMmAndHu * bone * std::max(0.0, screw.engaged_mm);
  if (screw.is_stripped) return kStrippedShare * cutting;
  return cutting + kNutFactor * screw.diameter_mm * std::max(0.0, screw.compression_n);
}

}  // namespace carpus::instruments
