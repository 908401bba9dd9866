// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluoroscopic views that the procedure asks for, as ranges of the C-arm's two angles, and what a
// shot costs.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/units.hpp"

namespace carpus::procedure {

/// One fluoroscopy picture as the procedure sees it.
struct Shot {
  double rotation_deg = 0.0;  ///< as fluoroscopy/c_arm.hpp: 0 PA, 90 lateral, 45 pronated oblique
  double tilt_deg = 0.0;      ///< towards proximal (positive) or distal
  Tick tick = 0;
  bool wire_in_bone = false;  ///< the wire had reached its final depth range (Step::Drive done)
  bool screw_in = false;      ///< the screw was seated
  bool operator==(const Shot&) const = default;
};

/// Views with a name; docs/scoring.md gives ranges and reasons.
enum class View : std::uint8_t {
  Pa = 0,
  Lateral = 1,
  PronatedOblique =
      2,  ///< 45 degrees pronated: most sensitive for distal penetration [chammasndstandard]
  ProximalPole = 3,  ///< tilted: shows a screw that stands out of the proximal pole [skyline2021]
};
inline constexpr int kViewCount = 4;

/// "pa", "lateral", "pronated_oblique", "proximal_pole".
[[nodiscard]] std::string_view name_of(View view) noexcept;

/// Whether a shot at these angles counts as this view. Plain comparisons: safe in World::step.
[[nodiscard]] bool shows(View view, double rotation_deg, double tilt_deg) noexcept;

/// Two shots count as different views when rotation or tilt differ by at least this much.
inline constexpr double kDifferentViewDeg = 20.0;

/// Dose-area product of one shot [cGy cm2], an engineering figure: about one second of a mini
/// C-arm; a whole conventional operation takes 45.6 cGy cm2 [navigatedndscaphoid].
inline constexpr double kDosePerShotCgyCm2 = 0.5;

}  // namespace carpus::procedure
