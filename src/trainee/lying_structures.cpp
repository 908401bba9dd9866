// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/lying_structures.hpp"

#include "geometry/rigid_blend.hpp"

namespace carpus::trainee {
namespace {

DualQuaternion motion_of(const cases::CaseData& data,
                         const simulation::Snapshot& now,
                         BoneId bone) {
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone != bone) continue;
    return dual_quaternion(now.patient_from_bone[b].rotation, now.patient_from_bone[b].translation);
  }
  return {};
}

}  // namespace

std::vector<LyingPoint> structures_now(const cases::CaseData& data,
                                       const simulation::Snapshot& now) {
  const DualQuaternion hand = motion_of(data, now, BoneId::Capitate);
  std::vector<LyingPoint> points;
  for (const cases::Structure& structure : data.structures) {
    const DualQuaternion forearm = motion_of(data, now, structure.forearm);
    for (const cases::StructurePoint& point : structure.course) {
      RigidBlend blend;
      blend.add(forearm, 1.0 - point.hand_share);
      blend.add(hand, point.hand_share);
      points.push_back({blend.moved(point.at), structure.radius_mm});
    }
  }
  return points;
}

}  // namespace carpus::trainee
