// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw's envelope and what of it stands out of a bone: the one measure of it, for the score and
// for what is told and shown afterwards.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.hpp"
#include "geometry/vec3.hpp"

namespace carpus::instruments {

/// A cone between two flat ends [mm].
struct ScrewEnvelope {
  Vec3 tail;
  Vec3 tip;
  double tail_radius_mm = 0.0;
  double tip_radius_mm = 0.0;

  [[nodiscard]] double radius_at(double along) const noexcept {
    return tail_radius_mm + (tip_radius_mm - tail_radius_mm) * along;
  }
};

/// Of an envelope.
struct DeepestPlace {
  double outside_mm = 0.0;  ///< 0: nothing stands out
  double along = 0.0;       ///< 0 at the tail, 1 at the tip
  Vec3 point;
};

/// What stands out farthest between two places along the envelope. An end counts to its rim: on an
/// oblique surface the rim comes out first, and it is the rim that a finger or a probe feels and
/// that wears the cartilage; the middle of the end is then still covered. To 0.01 mm on a surface
/// that is even over half a millimetre.
/// @param outside  distance of a point to the bone's outer surface, negative inside [mm].
template <typename Outside>
[[nodiscard]] DeepestPlace farthest_outside(const ScrewEnvelope& screw,
                                            double from,
                                            double to,
                                            Outside&& outside) {
  constexpr double kStepMm = 0.5;
  constexpr int kAround = 24;
  constexpr int kRounds = 12;
  const Vec3 way = screw.tip - screw.tail;
  const Vec3 axis = normalized_or(way, {0, 0, 1});
  const Vec3 a = any_perpendicular(axis);
  const Vec3 b = cross(axis, a);
  DeepestPlace worst;
  const auto consider = [&](double along, const Vec3& p) {
    const double out = outside(p);
    if (out > worst.outside_mm) worst = {out, along, p};
    return out;
  };
  const auto at_side = [&](double along, double angle) {
    return consider(along,
                    screw.tail + way * along +
                        (a * std::cos(angle) + b * std::sin(angle)) * screw.radius_at(along));
  };
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) * length(way) / kStepMm)));
  double best_along = 0.0;
  double best_angle = 0.0;
  double best = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double along = from + (to - from) * i / steps;
    consider(along, screw.tail + way * along);
    for (int j = 0; j < kAround; ++j) {
      const double angle = 2 * kPi * j / kAround;
      const double out = at_side(along, angle);
      if (out <= best) continue;
      best = out;
      best_along = along;
      best_angle = angle;
    }
  }
  if (!(best > 0.0)) return worst;
  // Between the samples: a search by halves around the best of them.
  double along_step = 0.5 * (to - from) / steps;
  double angle_step = kPi / kAround;
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& [da, dt] :
         {std::pair{-along_step, 0.0}, {along_step, 0.0}, {0.0, -angle_step}, {0.0, angle_step}}) {
      const double along = std::clamp(best_along + da, from, to);
      const double out = at_side(along, best_angle + dt);
      if (out <= best) continue;
      best = out;
      best_along = along;
      best_angle += dt;
    }
    along_step *= 0.5;
    angle_step *= 0.5;
  }
  return worst;
}

}  // namespace carpus::instruments
