// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of the phantom's bones: the parametric wrist with its shafts continued beyond the
// cut, and the scaphoid broken where asked for.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "anatomy/wrist_model.hpp"
#include "phantom/fracture.hpp"

namespace carpus::phantom {

/// One surface: a bone or a fragment.
struct Shape {
  BoneId bone = BoneId::Radius;
  BonePart part = BonePart::Whole;
  std::uint8_t label = 0;
  Aabb bounds;  ///< holds all of it, shaft included; frame Wrist of the model [mm]
};

/// How a shaft goes on beyond the cut.
struct Shaft {
  Plane section;         ///< just inside the model's cut
  Vec3 axis{};           ///< unit, away from the joint
  Vec3 centre{};         ///< of the main section
  double radius_mm = 0;  ///< of the main section, about its centre
  double narrowing = 1;  ///< of the section, at the end of the narrowing
  double narrows_over_mm = 1;
};

/// Frame Wrist of the model, unscaled [mm].
class BoneShapes {
 public:
  BoneShapes(const anatomy::WristModel& model, const std::optional<Fracture>& fracture);

  /// In the order of their labels; a broken scaphoid is two.
  [[nodiscard]] const std::vector<Shape>& shapes() const noexcept { return shapes_; }

  /// Implicit value: zero on the surface, negative inside, at most the distance outside.
  [[nodiscard]] double value(const Shape& shape, const Vec3& p) const noexcept;

  /// Signed distance to first order within 2.5 mm of the surface, elsewhere only its sign and that
  /// it is farther.
  [[nodiscard]] double signed_distance(const Shape& shape, const Vec3& p) const noexcept;

  /// How far towards the end of the shaft: 0 in a joint end (and in every carpal bone), 1 in the
  /// shaft.
  [[nodiscard]] double shaft_fraction(BoneId bone, const Vec3& p) const noexcept;

  /// Whether a point outside the fragments is tissue between their faces.
  [[nodiscard]] bool is_gap_tissue(const Vec3& p) const noexcept;

  /// Distance from the fracture's face into a fragment [mm].
  [[nodiscard]] double depth_from_fracture(BonePart part, const Vec3& p) const noexcept;

  [[nodiscard]] const std::optional<Fracture>& fracture() const noexcept { return fracture_; }

 private:
  [[nodiscard]] bool is_apart() const noexcept { return fracture_ && fracture_->is_apart; }
  [[nodiscard]] double long_bone_value(BoneId bone, const Vec3& p) const noexcept;
  [[nodiscard]] double fragment_value(BonePart part, const Vec3& p) const noexcept;

  const anatomy::WristModel* model_;
  std::optional<Fracture> fracture_;
  std::vector<Shape> shapes_;
  std::array<Shaft, kBoneCount> shafts_{};
};

}  // namespace carpus::phantom
