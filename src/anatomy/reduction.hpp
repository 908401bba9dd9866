// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the two fragments of a broken bone belong together: by their fracture faces, which were one.
#pragma once

#include <optional>

#include "geometry/mesh_in.hpp"
#include "geometry/pose.hpp"

namespace carpus::anatomy {

/// How far from each other two fragments lie.
struct FractureOffset {
  double gap_mm = 0.0;        ///< between the middles of the faces, along the first one's normal
  double step_mm = 0.0;       ///< across it
  double cosine_angle = 1.0;  ///< of the angle between the faces
};

/// Displaced: 1 mm is [clinical: K, B1 step 1], and faces are found to half of that; 10 degrees
/// [E].
[[nodiscard]] constexpr bool lies_apart(const FractureOffset& offset) noexcept {
  constexpr double kAlignedMm = 1.5;
  constexpr double kAlignedCosine = 0.985;
  return offset.gap_mm > kAlignedMm || offset.step_mm > kAlignedMm ||
         offset.cosine_angle < kAlignedCosine;
}

/// The fracture's faces as scanned, frame Bone of both fragments (equal then) [mm].
struct Reduction {
  Vec3 first_middle;   ///< of the first fragment's face
  Vec3 first_normal;   ///< unit, out of it
  Vec3 second_middle;  ///< of the second fragment's
  Vec3 second_normal;

  /// @param first_from_second  how the second fragment lies now, seen from the first: the identity
  ///                           as scanned.
  [[nodiscard]] FractureOffset offset(
      const Pose<frame::Bone, frame::Bone>& first_from_second) const noexcept;

  /// How the second fragment lies, seen from the first, once the faces meet: turned by the least
  /// angle that lets them oppose each other.
  [[nodiscard]] Pose<frame::Bone, frame::Bone> first_from_second_reduced() const noexcept;
};

/// Finds the two faces: facets of each fragment that have one of the other within 5 mm that looks
/// back at them. Reduced, their middles meet and their normals oppose each other. How they lie
/// turned about that normal is not told: faces are nearly round. Where bone was lost (an old
/// nonunion), a fracture oblique by an angle a keeps a step of the lost thickness times tan a,
/// though the outsides continue each other: 0.5 mm for 1.7 mm and 17 degrees. Nothing where a
/// fragment has no face of at least 20 mm2.
[[nodiscard]] std::optional<Reduction> reduction_of(const MeshIn<frame::Bone>& first,
                                                    const MeshIn<frame::Bone>& second);

}  // namespace carpus::anatomy
