// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// HU of bone, by depth below its surface. Figures: scaphoid thirds 542 / 293 / 298 HU on average
// [intactdensityndscaphoid], fractured poles 620 / 453 with the outer 2 mm densest
// [fractureddensityndscaphoid], cortex 1000 to 1800 HU and 0.3 to 1.0 mm thick in carpal bones
// (general knowledge, not confirmed).
#pragma once

#include <cstdint>

#include "phantom/bone_shapes.hpp"

namespace carpus::phantom {

class BoneTissue {
 public:
  BoneTissue(const BoneShapes& shapes, const LongAxis& scaphoid_axis, std::uint64_t seed);

  /// HU at a point `depth_mm` >= 0 below the surface of `shape`, before blur and noise.
  [[nodiscard]] double hounsfield(const Shape& shape,
                                  const Vec3& p,
                                  double depth_mm) const noexcept;

  /// HU of the tissue in the fracture gap.
  [[nodiscard]] double gap_hounsfield(const Vec3& p) const noexcept;

 private:
  [[nodiscard]] double core(const Shape& shape, const Vec3& p, double depth_mm) const noexcept;

  const BoneShapes* shapes_;
  LongAxis scaphoid_;
  std::uint64_t seed_;
};

}  // namespace carpus::phantom
