// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/outer_bone.hpp"

#include <cmath>

namespace carpus::procedures::scaphoid_fixation {

double OuterBone::depth_mm(const Vec3& point) const {
  const auto nearest = surface_.nearest(point);
  const double distance_mm = nearest ? std::sqrt(nearest->squared_distance) : 0.0;
  return solid_.encloses(point) ? distance_mm : -distance_mm;
}

}  // namespace carpus::procedures::scaphoid_fixation
