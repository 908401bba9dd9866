// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/case_data.hpp"

namespace carpus::cases {

const Bone* find_bone(const CaseData& data, BoneId bone, BonePart part) noexcept {
  for (const Bone& candidate : data.bones) {
    if (candidate.bone == bone && candidate.part == part) return &candidate;
  }
  return nullptr;
}

Pose<frame::Wrist, frame::Patient> held_wrist_from_patient(const CaseData& data) {
  // The wrist's axes are fixed in the forearm, as its bones are.
  const Pose<frame::Wrist, frame::Bone> wrist_from_forearm{data.wrist_from_patient.rotation,
                                                           data.wrist_from_patient.translation};
  return wrist_from_forearm * data.operative_posture.patient_from_forearm.inverse();
}

std::vector<const Bone*> scaphoid_parts(const CaseData& data) {
  std::vector<const Bone*> parts;
  for (const Bone& bone : data.bones) {
    if (bone.bone == BoneId::Scaphoid) parts.push_back(&bone);
  }
  return parts;
}

}  // namespace carpus::cases
