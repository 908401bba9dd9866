// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Points outside a growing hull, and the test of many of them against many planes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "geometry/vec3.hpp"
#include "hull/detail/orientation.hpp"
#include "hull/detail/point_pairs.hpp"

namespace carpus::hull {

/// Half a cache line: a point is moved whole. Not a Vec3 inside, whose zeros would be written to
/// every element of an array that is made.
struct Conflict {
  double x;
  double y;
  double z;
  std::uint32_t index;  ///< in the input
  std::uint32_t slot;   ///< in a large batch: its target, or the number of targets for none

  [[nodiscard]] Vec3 point() const { return {x, y, z}; }
};
static_assert(std::is_trivially_default_constructible_v<Conflict>);

/// Unwritten, so that memory which is never needed is never touched.
using ConflictArray = std::unique_ptr<Conflict[]>;  // NOLINT(modernize-avoid-c-arrays)
[[nodiscard]] inline ConflictArray unwritten_conflicts(std::size_t count) {
  return std::make_unique_for_overwrite<Conflict[]>(count);  // NOLINT(modernize-avoid-c-arrays)
}

/// Heights within +- this say nothing; of an exact plane every height does.
[[nodiscard]] inline double doubt_of(const OrientedPlane& plane) {
  return plane.bound > 0 ? plane.bound : -1;
}

/// Some points, coordinates apart, and for each the last target whose plane it is above.
class PointBlock {
 public:
  static constexpr std::size_t kMost = 256;

  void clear() { count_ = 0; }
  /// @param is_wanted  false: the next one takes its place.
  void push(const Conflict& conflict, bool is_wanted = true) {
    x_[count_] = conflict.x;
    y_[count_] = conflict.y;
    z_[count_] = conflict.z;
    source_[count_] = &conflict;
    count_ += is_wanted ? 1 : 0;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const Conflict& source(std::size_t i) const { return *source_[i]; }

  /// To be called between the last push and the first mark.
  void unmark(std::uint32_t nowhere);
  /// Notes `slot` for the points certainly above the plane. @return whether there is a doubtful
  /// one.
  bool mark_above(const OrientedPlane& plane, std::uint32_t slot);
  [[nodiscard]] std::uint32_t slot(std::size_t i) const {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(slot_[i]));
  }
  void set_slot(std::size_t i, std::uint32_t slot) { slot_[i] = static_cast<double>(slot); }

 private:
  using Coordinates = std::array<double, kMost + 2>;

  std::size_t count_ = 0;
  Coordinates x_;
  Coordinates y_;
  Coordinates z_;
  Coordinates slot_;
  std::array<const Conflict*, kMost + 2> source_;
};

}  // namespace carpus::hull
