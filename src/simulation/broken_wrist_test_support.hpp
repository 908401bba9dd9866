// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A broken bone for tests.
#pragma once

#include "fields/distance_field.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation::test {

/// The synthetic wrist with its scaphoid in two, 3 mm apart on their axis.
inline const cases::CaseData& broken_wrist() {
  static const cases::CaseData made = [] {
    cases::CaseData data = wrist();
    const cases::test::Ellipsoid whole = cases::test::synthetic_scaphoid();
    const Vec3 towards_distal = normalized_or(
        data.scaphoid.central_axis.distal - data.scaphoid.central_axis.proximal, {0, 0, 1});
    std::erase_if(data.bones, [](const cases::Bone& b) { return b.bone == BoneId::Scaphoid; });
    for (const BonePart part : {BonePart::Proximal, BonePart::Distal}) {
      const double side = part == BonePart::Proximal ? -7.5 : 7.5;
      cases::Bone bone;
      bone.bone = BoneId::Scaphoid;
      bone.part = part;
      bone.surface = MeshIn<frame::Bone>(cases::test::surface_of(
          {whole.centre + towards_distal * side, whole.rotation, {5.6, 4.8, 6.0}}, 4));
      bone.hull = cases::test::polytope_of_convex(bone.surface);
      bone.distance_field = fields::build_distance_field(bone.surface);
      data.bones.push_back(std::move(bone));
    }
    return data;
  }();
  return made;
}

}  // namespace carpus::simulation::test
