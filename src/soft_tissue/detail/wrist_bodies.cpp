// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/wrist_bodies.hpp"

namespace carpus::soft_tissue::detail {

std::size_t body_of(BoneId bone) noexcept {
  switch (bone) {
    case BoneId::Radius:
    case BoneId::Ulna:
      return kForearm;
    case BoneId::Scaphoid:
      return kScaphoid;
    case BoneId::Lunate:
      return kLunate;
    case BoneId::Triquetrum:
    case BoneId::Pisiform:
      return kTriquetrum;
    default:
      return kHand;
  }
}

std::size_t body_of_label(const cases::CaseData& data, std::uint8_t label) noexcept {
  for (const cases::Bone& bone : data.bones) {
    if (bone.label == label) return body_of(bone.bone);
  }
  return kForearm;
}

Bodies bodies_as_scanned(const cases::CaseData& data) {
  Bodies bodies;
  std::array<double, kBodies> count{};
  for (const cases::Bone& bone : data.bones) {
    PlacedBody& body = bodies[body_of(bone.bone)];
    if (bone.bone > BoneId::Hamate) continue;
    for (const Vec3& v : bone.surface.vertices) body.middle += v;
    count[body_of(bone.bone)] += static_cast<double>(bone.surface.vertices.size());
  }
  for (std::size_t b = 0; b < kBodies; ++b) {
    if (count[b] > 0) bodies[b].middle = bodies[b].middle / count[b];
  }
  return bodies;
}

}  // namespace carpus::soft_tissue::detail
