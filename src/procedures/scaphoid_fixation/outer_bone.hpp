// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How deep a point lies in a bone, from its triangles.
#pragma once

#include <span>

#include "anatomy/bone_solid.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// A bone, whole or broken; frame Bone, as scanned.
class OuterBone {
 public:
  /// @throws InvalidInput as BoneSolid.
  explicit OuterBone(std::span<const MeshIn<frame::Bone>* const> fragments)
      : solid_(fragments), surface_(solid_.outer_surface()) {}

  /// Distance to the outer surface [mm], negative outside. Fracture faces are no surface.
  [[nodiscard]] double depth_mm(const Vec3& point) const;
  [[nodiscard]] const BoneSolid& solid() const noexcept { return solid_; }

 private:
  BoneSolid solid_;
  fields::TriangleTree surface_;
};

}  // namespace carpus::procedures::scaphoid_fixation
