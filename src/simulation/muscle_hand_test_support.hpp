// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hand of flesh that feels what it is given, and what the world is told of it.
#pragma once

#include <cstddef>

#include "core/units.hpp"
#include "haptics/virtual_coupling.hpp"
#include "simulation/quantisation.hpp"

namespace carpus::simulation::test {

/// A hand that is drawn to a place by a muscle against the force that it feels, never faster than a
/// hand accelerates.
struct MuscleHand {
  void step(const Vec3& wanted, const Vec3& force) {
    constexpr double kMassKg = 0.3;
    const Vec3 muscle = (wanted - place) * 0.5;
    Vec3 change = (muscle + force) * (1000.0 / kMassKg * kTickSeconds * kTickSeconds);
    // Less the step of an input: what the world is given are whole units.
    const double most = haptics::kMostSurpriseMm - 8 * kPositionUnitMm;
    const double far = length(change);
    if (far > most) change *= most / far;
    move = (move + change) * 0.99;
    place += move;
  }
  Vec3 place;
  Vec3 move;
};

/// The world moves by whole units: that is the hand that it feels.
inline Vec3 as_given(Vec3 place) {
  for (std::size_t i = 0; i < 3; ++i) place[i] = quantised(place[i], kPositionUnitMm);
  return place;
}

}  // namespace carpus::simulation::test
