// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/scaphoid_landmarks.hpp"

#include "anatomy/central_axis.hpp"
#include "core/error.hpp"

namespace carpus::cases {

Vec3 proximal_direction(const CaseData& data) noexcept {
  return (data.wrist_from_patient.inverse() * Direction<frame::Wrist>{{1, 0, 0}}).v;
}

std::optional<ScaphoidLandmarks> find_scaphoid_landmarks(
    std::span<const MeshIn<frame::Bone>* const> pieces,
    const Vec3& towards_proximal) {
  const auto found = find_central_axis(BoneSolid(pieces), towards_proximal);
  if (!found) return std::nullopt;
  return ScaphoidLandmarks{{found->axis.start, found->axis.end},
                           found->radius_mm,
                           {found->longest_line.start, found->longest_line.end},
                           found->waist};
}

ScaphoidLandmarks find_scaphoid_landmarks(const CaseData& data) {
  std::vector<const MeshIn<frame::Bone>*> fragments;
  for (const Bone* part : scaphoid_parts(data)) fragments.push_back(&part->surface);
  if (fragments.empty()) {
    throw InvalidInput("scaphoid landmarks: the case has no scaphoid; check the bones' names");
  }
  const auto found = find_scaphoid_landmarks(fragments, proximal_direction(data));
  if (!found) {
    throw InvalidInput(
        "scaphoid landmarks: no straight line fits inside the scaphoid; its surface is broken, "
        "segment the CT again");
  }
  return *found;
}

}  // namespace carpus::cases
