// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Size, place and proportions of the parametric wrist's bones, with the hand held in many ways.
#pragma once

#include <array>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "anatomy/region_shape.hpp"
#include "anatomy/wrist_model.hpp"
#include "geometry/mat3.hpp"

namespace carpus::anatomy {

/// Shapes in the order of kAllBones, frame Wrist of the model's side [mm].
using ModelShapes = std::array<BodyShape, kBoneCount>;

/// Measures the model on a lattice of 0.7 mm. The shafts that the model cuts count as cut.
[[nodiscard]] ModelShapes measure_model(const WristModel& model);

/// The same for the generic wrist of one side, measured once.
[[nodiscard]] const ModelShapes& generic_model_shapes(Side side);

/// One way to hold the hand: the forearm at rest, the carpal rows and the hand turned.
class Posture {
 public:
  /// Half of each angle happens between forearm and carpus, half between the two carpal rows, as in
  /// life to a first approximation [ruby1988relative].
  Posture(const ModelShapes& shapes, const Mat3& half_turn);

  /// Where a point of a bone comes to lie; frame Wrist [mm].
  [[nodiscard]] Vec3 place(BoneId bone, const Vec3& p) const noexcept;

 private:
  Vec3 radiocarpal_;
  Vec3 midcarpal_;
  Mat3 half_turn_;
};

/// Eighteen postures from 70 degrees of extension to 30 of flexion and 15 degrees of ulnar to 25 of
/// radial deviation.
[[nodiscard]] std::vector<Posture> all_postures(const ModelShapes& shapes, Side side);

}  // namespace carpus::anatomy
