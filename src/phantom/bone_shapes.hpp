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
  Aabb bounds;       ///< holds all of it, shaft included; frame Wrist of the model [mm]
  int phalanx = -1;  ///< place in BoneShapes' fingers; -1: a bone of the wrist
};

/// A bone of a finger: a rod between two knobs. Simulated to be left out: no bone of a case.
struct Phalanx {
  Vec3 from{};
  Vec3 to{};
  double rod_mm = 0;   ///< radius
  double knob_mm = 0;  ///< radius
};

/// How a shaft goes on beyond the cut.
struct Shaft {
  Plane section;         ///< just inside the model's cut
  Vec3 axis{};           ///< unit, away from the joint
  Vec3 centre{};         ///< of the main section
  double radius_mm = 0;  ///< of the main section, about its centre
  double narrowing = 1;  ///< of the section, at the end of the narrowing
  double narrows_over_mm = 1;
  double length_mm = 0;  ///< past the section; then a head, where there are fingers
  double head_mm = 0;    ///< radius; 0: the shaft just ends, beyond every field of view
};

/// Frame Wrist of the model, unscaled [mm].
class BoneShapes {
 public:
  /// @param has_fingers  metacarpals end in heads, and phalanges follow
  BoneShapes(const anatomy::WristModel& model,
             const std::optional<Fracture>& fracture,
             bool has_fingers = false);

  /// In the order of their labels; a broken scaphoid is two; phalanges last.
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
  [[nodiscard]] double phalanx_value(int phalanx, const Vec3& p) const noexcept;
  void add_finger(const anatomy::ModelBone& metacarpal);

  const anatomy::WristModel* model_;
  std::optional<Fracture> fracture_;
  std::vector<Shape> shapes_;
  std::array<Shaft, kBoneCount> shafts_{};
  std::vector<Phalanx> fingers_;
};

}  // namespace carpus::phantom
