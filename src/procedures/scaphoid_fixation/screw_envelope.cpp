// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/screw_envelope.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::procedures::scaphoid_fixation {

ScrewEnvelope envelope_of(const procedure::LineFacts& lain) {
  const instruments::Instrument& screw = instruments::catalogue()[lain.instrument];
  const auto at = [&](double depth_mm) {
    return lain.entry_in_bone + lain.direction_in_bone * depth_mm;
  };
  return {at(lain.depth_mm - screw.length_mm), at(lain.depth_mm), 0.5 * screw.tail_diameter_mm,
          0.5 * screw.tip_diameter_mm};
}

DeepestPlace farthest_outside(const OuterBone& bone, const ScrewEnvelope& screw) {
  return instruments::farthest_outside(screw, 0.0, 1.0,
                                       [&](const Vec3& p) { return -bone.depth_mm(p); });
}

double least_bone_beside(const OuterBone& bone, const ScrewEnvelope& screw, double ends_mm) {
  constexpr double kStepMm = 0.25;
  const Vec3 way = screw.tip - screw.tail;
  const double length_mm = length(way);
  const double from = std::min(0.5, ends_mm / length_mm);
  const int steps =
      std::max(1, static_cast<int>(std::ceil((1.0 - 2.0 * from) * length_mm / kStepMm)));
  double least = 1e30;
  for (int i = 0; i <= steps; ++i) {
    const double along = from + (1.0 - 2.0 * from) * i / steps;
    least = std::min(least, bone.depth_mm(screw.tail + way * along) - screw.radius_at(along));
  }
  return least;
}

}  // namespace carpus::procedures::scaphoid_fixation
