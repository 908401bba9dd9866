// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/reduced_scaphoid.hpp"

#include <array>

#include "anatomy/reduction.hpp"
#include "cases/scaphoid_landmarks.hpp"

namespace carpus::cases {

std::optional<ReducedScaphoid> find_reduced_scaphoid(const CaseData& data) {
  const Bone* proximal = find_bone(data, BoneId::Scaphoid, BonePart::Proximal);
  const Bone* distal = find_bone(data, BoneId::Scaphoid, BonePart::Distal);
  if (proximal == nullptr || distal == nullptr) return std::nullopt;
  const auto faces = anatomy::reduction_of(proximal->surface, distal->surface);
  if (!faces || !anatomy::lies_apart(faces->offset({}))) return std::nullopt;
  const Pose<frame::Bone, frame::Bone> proximal_from_distal = faces->first_from_second_reduced();
  const MeshIn<frame::Bone> led = proximal_from_distal * distal->surface;
  const std::array<const MeshIn<frame::Bone>*, 2> pieces{&proximal->surface, &led};
  const AxisSegment& scanned = data.scaphoid.central_axis;
  const auto marks = find_scaphoid_landmarks(pieces, scanned.proximal - scanned.distal);
  if (!marks) return std::nullopt;
  return ReducedScaphoid{*marks, proximal_from_distal};
}

}  // namespace carpus::cases
