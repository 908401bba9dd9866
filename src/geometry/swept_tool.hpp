// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The space through which a turning tool went on a straight way: what drilling takes out of bone.
// The balls of an InstrumentShape only grow towards the hand. Moved along its own axis, the shape
// therefore sweeps its foremost pose with the widest ball drawn out backwards by the way: again
// balls on one line, with an exact distance. One that moves sideways sweeps a bar a ball.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/aabb.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

/// Union of balls in frame Bone: centres on one straight line, radius linear between knots.
class SweptTool {
 public:
  /// Nothing, and not sound.
  SweptTool() = default;

  /// The hull of two balls: a round bar, tapered where the radii differ. Where one ball lies within
  /// the other, that other.
  /// @param a, b  centres in frame Bone [mm]; radii 0 or more [mm].
  [[nodiscard]] static SweptTool bar(const Vec3& a,
                                     double radius_at_a_mm,
                                     const Vec3& b,
                                     double radius_at_b_mm) noexcept;

  /// The whole shape at a pose to which it came along its own axis, tip first.
  /// @param travel_mm  of that way, 0 or more.
  [[nodiscard]] static SweptTool whole(const InstrumentShape& shape,
                                       const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                                       double travel_mm = 0) noexcept;

  /// What the last `travel_mm` of that way added: the shape up to where it is widest, drawn out
  /// backwards by the way. The ball at its back was swept before: together with
  /// whole(shape, pose before) it is whole(shape, pose, travel_mm).
  [[nodiscard]] static SweptTool advance(const InstrumentShape& shape,
                                         const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                                         double travel_mm) noexcept;

  /// Wider by the same way everywhere, ends too: a turning tool wobbles and cuts its hole a little
  /// wider than itself. Every ball of this tool then is free in the hole by that way.
  /// @param by_mm  0 or more.
  [[nodiscard]] SweptTool widened(double by_mm) const noexcept;

  /// False if a number that it was made of was not finite, or a radius or way less than 0.
  [[nodiscard]] bool is_sound() const noexcept { return is_sound_; }
  /// Where z is 0, and the unit direction in which it grows; both in frame Bone.
  [[nodiscard]] const Vec3& origin() const noexcept { return origin_; }
  [[nodiscard]] const Vec3& axis() const noexcept { return axis_; }
  /// z rising; one to four.
  [[nodiscard]] std::span<const AxisKnot> knots() const noexcept { return {knots_.data(), count_}; }
  [[nodiscard]] double greatest_radius_mm() const noexcept;
  /// The ball of the last knot lies in what was swept before.
  [[nodiscard]] bool is_back_known() const noexcept { return is_back_known_; }

  /// The balls' own box [mm].
  [[nodiscard]] Aabb bounds() const noexcept;
  /// Exact distance to the union [mm]; inside, less the depth, exact for a bar and for shapes whose
  /// radius grows ever more slowly, as all InstrumentShapes'.
  [[nodiscard]] double signed_distance(const Vec3& point_in_bone) const noexcept;

 private:
  void add(const AxisKnot& knot) noexcept;
  void check() noexcept;

  Vec3 origin_;
  Vec3 axis_{0, 0, 1};
  std::array<AxisKnot, 4> knots_{};
  std::size_t count_ = 0;
  bool is_back_known_ = false;
  bool is_sound_ = false;
};

}  // namespace carpus
