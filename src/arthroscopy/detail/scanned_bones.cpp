// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From the bones' distance fields; a bone without one is not seen.
#include "arthroscopy/detail/scanned_bones.hpp"

#include <algorithm>
#include <cstddef>

#include "fields/distance_field.hpp"

namespace carpus::arthroscopy::detail {

std::uint8_t nearest_body(const cases::CaseData& data, const Vec3& point) {
  std::uint8_t best = 0;
  double least = 1e18;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].distance_field.values().empty()) continue;
    const auto s = fields::sample_distance(data.bones[b].distance_field, point);
    if (s.is_inside_grid && s.distance_mm < least) {
      least = s.distance_mm;
      best = static_cast<std::uint8_t>(b);
    }
  }
  return best;
}

double distance_mm_to(const cases::CaseData& data, BoneId id, const Vec3& point) {
  double least = kFarMm;
  for (const cases::Bone& bone : data.bones) {
    if (bone.bone != id || bone.distance_field.values().empty()) continue;
    const auto s = fields::sample_distance(bone.distance_field, point);
    if (s.is_inside_grid) least = std::min(least, s.distance_mm);
  }
  return least;
}

}  // namespace carpus::arthroscopy::detail
