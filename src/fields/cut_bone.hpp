// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is left of a bone: its own field and its cuts read as one, with what that is worth
// (cut_field.hpp proves it). D: signed distance to what is left.
#pragma once

#include <algorithm>

#include "fields/contact_field.hpp"
#include "fields/cut_field.hpp"
#include "geometry/vec3.hpp"

namespace carpus::fields {

struct CutBone {
  const ContactField& bone;
  const CutField& cut;

  /// max(f_d, f_c) at a point of frame Bone [mm]; +reach outside the bone's grid. Real-time.
  [[nodiscard]] double sample(const Vec3& point) const noexcept {
    return std::max(bone.sample(point), cut.sample(point));
  }
  /// |sample - g| is at most this, g clamped.
  [[nodiscard]] double error_mm() const noexcept {
    return std::max(bone.error_mm(), cut.error_mm());
  }
  /// D is at least this, or what is left is deeper than kCutDepthMm.
  [[nodiscard]] double lowest_distance(const Vec3& point) const noexcept {
    return std::max({bone.lowest_distance(bone.sample(point)),
                     cut.lowest_distance(cut.sample(point)), -kCutDepthMm});
  }
  /// Less than 0: the point lies in what is left, and D is at most this. Else it may lie anywhere,
  /// and says nothing of D.
  [[nodiscard]] double highest_if_bone(const Vec3& point) const noexcept {
    return std::max(bone.highest_distance(bone.sample(point)),
                    cut.highest_distance(cut.sample(point)));
  }
};

}  // namespace carpus::fields
