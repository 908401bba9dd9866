// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies around the bones of the phantom: the outline of hand and forearm, fat, muscle, tendons.
// Invented, to look like a hand and to surround bone with the right contrasts; not measured.
#pragma once

#include <cstdint>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/grid.hpp"
#include "phantom/bone_shapes.hpp"

namespace carpus::phantom {

/// A round strand between two points, frame Wrist of the model [mm].
struct Strand {
  Vec3 from{};
  Vec3 to{};
  double radius_mm = 0;
};

/// Frame Wrist of the model, unscaled [mm].
class SoftTissue {
 public:
  SoftTissue(const BoneShapes& bones, Side side, std::uint64_t seed);

  /// Depth below the skin [mm], about; negative in air. Smooth.
  [[nodiscard]] double depth(const Vec3& p) const noexcept;

  /// HU of soft tissue at a depth below the skin > 0, before blur and noise.
  [[nodiscard]] double hounsfield(const Vec3& p, double depth_mm) const noexcept;

  /// The box in which depth() knows the hand; it is air elsewhere.
  [[nodiscard]] const Grid<float>& coarse_depth() const noexcept { return depth_; }

 private:
  Grid<float> depth_;  ///< on a coarse grid in frame Wrist, which its geometry calls Patient
  std::vector<Strand> tendons_;
  std::uint64_t seed_;
};

/// Distance from a strand's surface [mm], negative inside.
[[nodiscard]] double distance_to(const Strand& strand, const Vec3& p) noexcept;

}  // namespace carpus::phantom
