// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The parametric wrist: fifteen bones of a generic adult, each a smooth union of ellipsoids given
// by an implicit function (data/wrist_model.json; provenance in data/README.md). The phantom is
// made from it, and segmentation names bones by fitting it. It is a model, not a person.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/aabb.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::anatomy {

/// One ellipsoid of a bone, frame Wrist.
struct ModelEllipsoid {
  Vec3 centre;             ///< mm
  Vec3 semi_axes;          ///< mm, along the ellipsoid's own axes
  Mat3 wrist_from_axes{};  ///< columns are the ellipsoid's axes
};

/// A point with the value that the implicit function (without the cut) must have there.
struct ModelCheckValue {
  Vec3 point;           ///< frame Wrist [mm]
  double value_mm = 0;  ///< mm
};

/// One bone of the model, frame Wrist.
struct ModelBone {
  BoneId bone = BoneId::Radius;
  double blend_radius_mm = 0;  ///< of the smooth union
  std::vector<ModelEllipsoid> ellipsoids;
  /// Ends the described piece of a long bone; its normal points out of the bone.
  std::optional<Plane> cut_plane;
  Vec3 shaft_axis{};      ///< unit vector along the shaft towards the cut; zero for a carpal bone
  double volume_mm3 = 0;  ///< of the described piece
  Aabb bounds;            ///< holds every point of the bone; at most about 2 mm too large
  std::vector<ModelCheckValue> check_values;
};

/// The model of one side, in the Wrist frame [mm]: +x proximal, +z volar, and +y ulnar on a left
/// wrist, radial on a right one.
class WristModel {
 public:
  /// The generic adult wrist near neutral posture, built in; parsed at the first call.
  [[nodiscard]] static const WristModel& generic(Side side = Side::Left);

  /// Reads the format of data/wrist_model.json; the text describes a left wrist.
  /// @throws InvalidInput naming the bone and field where the text is not such a model.
  [[nodiscard]] static WristModel parse(std::string_view json_text);

  /// The same wrist of the other side: y negated, so that each surface is the mirror image.
  [[nodiscard]] WristModel mirrored() const;

  [[nodiscard]] Side side() const noexcept { return side_; }
  [[nodiscard]] const ModelBone& bone(BoneId bone) const noexcept;
  [[nodiscard]] const std::array<ModelBone, kBoneCount>& bones() const noexcept { return bones_; }

  /// Implicit function of a bone at a point [mm]: zero on the surface, negative inside. Never more
  /// than the distance outside; near the surface the distance to first order; deeper than about
  /// 3 mm inside only the sign counts. A long bone ends at its cut plane.
  [[nodiscard]] double signed_value(BoneId bone, const Vec3& point_in_wrist) const noexcept;

  /// The same without the cut: only what lies within the cut plane is bone.
  [[nodiscard]] double uncut_value(BoneId bone, const Vec3& point_in_wrist) const noexcept;

 private:
  WristModel() = default;

  Side side_ = Side::Left;
  std::array<ModelBone, kBoneCount> bones_;
};

}  // namespace carpus::anatomy
