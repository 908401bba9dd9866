// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/cogging.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::arm {
namespace {
/// Faster than this a hand feels none of it, as the rotor's inertia takes it up, and the host, a
/// tick of 1 ms, could only guess: 80 Hz fades it, 160 Hz ends it.
constexpr double kFadesHz = 80;
constexpr double kEndsHz = 160;
}  // namespace

LegAngles cogging_torques(const Cogging& cogging, const LegAngles& angles) noexcept {
  LegAngles torques{};
  for (std::size_t i = 0; i < 3; ++i) {
    torques[i] = cogging.amplitude_n_mm[i] *
                 std::sin(cogging.periods_per_turn * angles[i] + cogging.phase_rad[i]);
  }
  return torques;
}

Vec3 against_cogging(const DeltaArm& arm,
                     const Cogging& cogging,
                     const LegAngles& angles,
                     const LegAngles& rates,
                     double ahead_s) noexcept {
  const auto state = firmware::delta_forward(arm.size, angles.data());
  if (!state.is_valid) return {};
  LegAngles then{};
  for (std::size_t i = 0; i < 3; ++i) then[i] = angles[i] + rates[i] * ahead_s;
  const LegAngles torques = cogging_torques(cogging, then);
  Vec3 force;
  for (std::size_t i = 0; i < 3; ++i) {
    const double hz = cogging.periods_per_turn * std::abs(rates[i]) / (2 * kPi);
    const double share = std::clamp((kEndsHz - hz) / (kEndsHz - kFadesHz), 0.0, 1.0);
    const Vec3 rod{state.rods[i].x, state.rods[i].y, state.rods[i].z};
    force -= rod * (share * torques[i] / state.levers[i]);
  }
  return is_finite(force) ? force : Vec3{};
}

}  // namespace carpus::arm
