// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a steel wire gives way and springs back: a cantilever of round section.
#pragma once

#include "geometry/vec3.hpp"

namespace carpus::simulation::detail {

/// Strain at which cold-drawn 316L yields: 1.2 GPa of 193 GPa [E].
inline constexpr double kYieldStrain = 0.006;
/// Bent by more it breaks: 35 degrees over a wrist [E].
inline constexpr double kBreakingRad = 0.6;

/// The bend that stays [rad] when a wire held in bone is pushed aside by `aside_mm` at `lever_mm`
/// from it. It springs back from a curvature of yield strain over radius, an end's way of a third
/// of that times the lever squared; what is beyond turns it by 3/2 of the way over the lever.
[[nodiscard]] constexpr double lasting_bend_rad(double aside_mm,
                                                double lever_mm,
                                                double radius_mm) noexcept {
  const double springs_back = kYieldStrain / radius_mm * lever_mm * lever_mm / 3.0;
  return aside_mm > springs_back ? 1.5 * (aside_mm - springs_back) / lever_mm : 0.0;
}

/// The direction of a bent part: `along` turned towards `aside` by `bend_rad`, to its second order,
/// which is within half a degree up to where a wire breaks.
[[nodiscard]] inline Vec3 bent(const Vec3& along, const Vec3& aside, double bend_rad) noexcept {
  const double cosine = 1.0 - 0.5 * bend_rad * bend_rad;
  const double sine = bend_rad * (1.0 - bend_rad * bend_rad / 6.0);
  return normalized_or(along * cosine + aside * sine, along);
}

}  // namespace carpus::simulation::detail
