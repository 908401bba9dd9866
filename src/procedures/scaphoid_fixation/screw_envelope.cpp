// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/screw_envelope.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

/// Axis of the envelope with two directions across.
struct Axis {
  explicit Axis(const ScrewEnvelope& screw)
      : tail(screw.tail),
        way(screw.tip - screw.tail),
        a(any_perpendicular(normalized_or(way, {0, 0, 1}))),
        b(cross(normalized_or(way, {0, 0, 1}), a)) {}
  Vec3 tail;
  Vec3 way;
  Vec3 a;
  Vec3 b;
};

double radius_at(const ScrewEnvelope& screw, double along) {
  return screw.tail_radius_mm + (screw.tip_radius_mm - screw.tail_radius_mm) * along;
}

Vec3 side_point(const Axis& axis, const ScrewEnvelope& screw, double along, double angle) {
  return axis.tail + axis.way * along +
         (axis.a * std::cos(angle) + axis.b * std::sin(angle)) * radius_at(screw, along);
}

}  // namespace

ScrewEnvelope envelope_of(const procedure::LineFacts& lain) {
  const instruments::Instrument& screw = instruments::catalogue()[lain.instrument];
  const auto at = [&](double depth_mm) {
    return lain.entry_in_bone + lain.direction_in_bone * depth_mm;
  };
  return {at(lain.depth_mm - screw.length_mm), at(lain.depth_mm), 0.5 * screw.tail_diameter_mm,
          0.5 * screw.tip_diameter_mm};
}

DeepestPlace farthest_outside(const OuterBone& bone, const ScrewEnvelope& screw) {
  constexpr double kStepMm = 0.5;
  constexpr int kAround = 16;
  const Axis axis(screw);
  const double length_mm = length(axis.way);
  DeepestPlace worst;
  const auto consider = [&](double along, const Vec3& p) {
    const double outside = -bone.depth_mm(p);
    if (outside > worst.outside_mm) worst = {outside, along, p};
    return outside;
  };
  consider(0.0, screw.tail);
  consider(1.0, screw.tip);
  const int steps = std::max(2, static_cast<int>(std::ceil(length_mm / kStepMm)));
  double best_along = 0.0;
  double best_angle = 0.0;
  double best_outside = 0.0;
  for (int i = 1; i < steps; ++i) {
    const double along = double{1} * i / steps;
    consider(along, axis.tail + axis.way * along);
    for (int j = 0; j < kAround; ++j) {
      const double angle = 2 * kPi * j / kAround;
      const double outside = consider(along, side_point(axis, screw, along, angle));
      if (outside <= best_outside) continue;
      best_outside = outside;
      best_along = along;
      best_angle = angle;
    }
  }
  if (!(best_outside > 0.0)) return worst;
  // Between the samples: a search by halves around the best of the side's.
  double along_step = 0.5 / steps;
  double angle_step = kPi / kAround;
  for (int round = 0; round < 12; ++round) {
    for (const auto& [da, dt] :
         {std::pair{-along_step, 0.0}, {along_step, 0.0}, {0.0, -angle_step}, {0.0, angle_step}}) {
      const double along = std::clamp(best_along + da, 1.0 / steps, 1.0 - 1.0 / steps);
      const double outside = consider(along, side_point(axis, screw, along, best_angle + dt));
      if (outside <= best_outside) continue;
      best_outside = outside;
      best_along = along;
      best_angle += dt;
    }
    along_step *= 0.5;
    angle_step *= 0.5;
  }
  return worst;
}

double least_bone_beside(const OuterBone& bone, const ScrewEnvelope& screw, double ends_mm) {
  constexpr double kStepMm = 0.25;
  const Axis axis(screw);
  const double length_mm = length(axis.way);
  const double from = std::min(0.5, ends_mm / length_mm);
  const int steps =
      std::max(1, static_cast<int>(std::ceil((1.0 - 2.0 * from) * length_mm / kStepMm)));
  double least = 1e30;
  for (int i = 0; i <= steps; ++i) {
    const double along = from + (1.0 - 2.0 * from) * i / steps;
    least = std::min(least, bone.depth_mm(axis.tail + axis.way * along) - radius_at(screw, along));
  }
  return least;
}

}  // namespace carpus::procedures::scaphoid_fixation
