// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two bodies at one pose, and corners of their Minkowski difference.
#pragma once

#include <cmath>
#include <cstdint>

#include "convex/pair_query.hpp"
#include "convex/support.hpp"
#include "geometry/mat3.hpp"
#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus::survey {

/// A point b - a of the Minkowski difference { b - a }, where b is a corner of the second body and
/// a one of the first. The bodies meet iff the origin is in the difference; their distance is the
/// origin's distance from it, their depth the origin's distance from its boundary.
struct DifferencePoint {
  Vec3 at;                   ///< b - a [mm]
  std::uint32_t first = 0;   ///< number of corner a
  std::uint32_t second = 0;  ///< number of corner b
};

/// How a support query starts.
enum class ClimbStart : std::uint8_t {
  LastCorner,  ///< where the last query of the pair ended
  Table,       ///< the better one of that and the table's corner
  ColdTable,   ///< Table while the pair remembers nothing, LastCorner from then on
};

/// Everything is in the first body's axes, with the first body's centre for origin. The distance
/// between the centres is computed with twice the digits, so that bodies far from their frames'
/// origins (coordinates of a CT) are as exact as others.
class PosedPair {
 public:
  PosedPair(const convex::SupportGraph& first,
            const convex::SupportGraph& second,
            const convex::PairPose& pose) noexcept;

  /// The same with the second body moved by `step` [mm].
  [[nodiscard]] PosedPair moved_by(const Vec3& step) const noexcept {
    PosedPair result = *this;
    result.offset_ += step;
    return result;
  }

  [[nodiscard]] const convex::SupportGraph& first() const noexcept { return first_; }
  [[nodiscard]] const convex::SupportGraph& second() const noexcept { return second_; }

  /// False where the pose is not a number or the scale leaves 1e-30 to 1e30 mm: no answer.
  [[nodiscard]] bool is_usable() const noexcept { return scale_mm_ > 1e-30 && scale_mm_ < 1e30; }
  /// Rounding of one height of a corner [mm], a bound.
  [[nodiscard]] double rounding_mm() const noexcept { return rounding_mm_; }

  /// The second body's centre [mm].
  [[nodiscard]] const Vec3& offset() const noexcept { return offset_; }
  [[nodiscard]] const Mat3& rotation() const noexcept { return rotation_; }
  [[nodiscard]] const Vec3& on_first(std::uint32_t i) const noexcept { return first_.corner(i); }
  [[nodiscard]] Vec3 on_second(std::uint32_t j) const noexcept {
    return rotation_ * second_.corner(j) + offset_;
  }
  /// The direction d of second-body coordinates with d . v = direction . (rotation * v).
  [[nodiscard]] Vec3 into_second(const Vec3& direction) const noexcept {
    return {
        rotation_.rows[0].x * direction.x + rotation_.rows[1].x * direction.y +
            rotation_.rows[2].x * direction.z,
        rotation_.rows[0].y * direction.x + rotation_.rows[1].y * direction.y +
            rotation_.rows[2].y * direction.z,
        rotation_.rows[0].z * direction.x + rotation_.rows[1].z * direction.y +
            rotation_.rows[2].z * direction.z,
    };
  }
  [[nodiscard]] DifferencePoint point(std::uint32_t first, std::uint32_t second) const noexcept {
    return {on_second(second) - on_first(first), first, second};
  }

  /// A point of the difference farthest along `direction`; the walks start at `near`'s corners.
  [[nodiscard]] DifferencePoint farthest(const Vec3& direction,
                                         const DifferencePoint& near,
                                         ClimbStart start) const noexcept {
    const Vec3 on_second_direction = into_second(direction);
    if (start == ClimbStart::Table) {
      return point(first_.climb_with_table(-direction, near.first),
                   second_.climb_with_table(on_second_direction, near.second));
    }
    return point(first_.climb(-direction, near.first),
                 second_.climb(on_second_direction, near.second));
  }

 private:
  const convex::SupportGraph& first_;
  const convex::SupportGraph& second_;
  Mat3 rotation_;
  Vec3 offset_;
  double scale_mm_;  // of what is computed: both radii and the distance of the centres
  double rounding_mm_;
};

}  // namespace carpus::survey
