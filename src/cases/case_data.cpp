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

std::vector<const Bone*> scaphoid_parts(const CaseData& data) {
  std::vector<const Bone*> parts;
  for (const Bone& bone : data.bones) {
    if (bone.bone == BoneId::Scaphoid) parts.push_back(&bone);
  }
  return parts;
}

}  // namespace carpus::cases
