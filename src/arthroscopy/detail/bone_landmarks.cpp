// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Extremes of the bones' own vertices, looked for where the generic wrist has the landmark.
#include "arthroscopy/detail/bone_landmarks.hpp"

#include <optional>

namespace carpus::arthroscopy::detail {
namespace {

/// Lister's tubercle: the most dorsal point of the radius where the generic one has it.
std::optional<Vec3> lister_of(const cases::CaseData& data, const WristAxes& axes) {
  const cases::Bone* radius = cases::find_bone(data, BoneId::Radius);
  if (radius == nullptr) return std::nullopt;
  std::optional<Vec3> best;
  for (const Vec3& v : radius->surface.vertices) {
    const Vec3 at = axes.left_of(v);
    if (at.x < 1 || at.x > 12 || at.y < -4.5 || at.y > 4.5 || at.z > 0) continue;
    if (!best || at.z < best->z) best = at;
  }
  return best;
}

/// A forearm bone's styloid: its most distal point.
std::optional<Vec3> styloid_of(const cases::CaseData& data, const WristAxes& axes, BoneId id) {
  const cases::Bone* bone = cases::find_bone(data, id);
  if (bone == nullptr) return std::nullopt;
  std::optional<Vec3> best;
  for (const Vec3& v : bone->surface.vertices) {
    const Vec3 at = axes.left_of(v);
    if (!best || at.x < best->x) best = at;
  }
  return best;
}

}  // namespace

std::vector<Landmark> bone_landmarks(const cases::CaseData& data, const WristAxes& axes) {
  const std::optional<Vec3> lister = lister_of(data, axes);
  if (!lister) return {};
  std::vector<Landmark> marks{{"lister", *lister}};
  const auto radial = styloid_of(data, axes, BoneId::Radius);
  if (radial) marks.push_back({"radial_styloid", *radial});
  const auto ulnar = styloid_of(data, axes, BoneId::Ulna);
  if (ulnar) marks.push_back({"ulnar_styloid", *ulnar});
  return marks;
}

}  // namespace carpus::arthroscopy::detail
