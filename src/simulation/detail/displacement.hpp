// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a bone or fragment lies beside where the wrist's motion takes it: a rigid motion in frame
// Bone, kept as a quaternion so that adding many small ones up keeps it rigid.
#pragma once

#include <type_traits>

#include "geometry/pose.hpp"
#include "geometry/rigid_blend.hpp"

namespace carpus::simulation::detail {

using InBone = Pose<frame::Bone, frame::Bone>;

struct Displacement {
  double w = 1.0;  ///< of the unit quaternion (w, turn)
  Vec3 turn;
  Vec3 shift;  ///< [mm]

  constexpr bool operator==(const Displacement&) const = default;
  [[nodiscard]] constexpr bool is_none() const noexcept { return *this == Displacement{}; }

  [[nodiscard]] InBone pose() const noexcept {
    return {rotation_from_quaternion(w, turn.x, turn.y, turn.z), shift};
  }
  [[nodiscard]] static Displacement of(const InBone& pose) noexcept {
    const Quaternion q = quaternion_from_rotation(pose.rotation);
    const double sign = q.w < 0 ? -1.0 : 1.0;
    return {sign * q.w, Vec3{q.x, q.y, q.z} * sign, pose.translation};
  }
  /// Nearer to none by this share.
  [[nodiscard]] Displacement eased(double share) const noexcept {
    Displacement next{w + (1.0 - w) * share, turn * (1.0 - share), shift * (1.0 - share)};
    const double size = std::sqrt(next.w * next.w + squared_length(next.turn));
    next.w /= size;
    next.turn *= 1.0 / size;
    return next;
  }
};

template <typename SomeDisplacement, typename Visitor>
void visit_displacement(SomeDisplacement& moved, Visitor&& v) noexcept {
  v(moved.w);
  v(moved.turn);
  v(moved.shift);
}

}  // namespace carpus::simulation::detail
