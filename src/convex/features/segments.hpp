// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Nearest points of two segments, also where they are nearly parallel.
#pragma once

#include "geometry/vec3.hpp"

namespace carpus::convex {

struct Segment {
  Vec3 tail;
  Vec3 along;  ///< head - tail

  [[nodiscard]] Vec3 at(double t) const noexcept { return tail + along * t; }
};

[[nodiscard]] inline double unit_clamp(double t) noexcept { return t > 0 ? (t < 1 ? t : 1) : 0; }

/// Parameter in [0, 1] of the point of `s` nearest to `p`.
[[nodiscard]] inline double nearest_on(const Segment& s, const Vec3& p) noexcept {
  const double squared = squared_length(s.along);
  return squared > 0 ? unit_clamp(dot(p - s.tail, s.along) / squared) : 0;
}

struct SegmentPair {
  double s = 0;  ///< parameter on the first, in [0, 1]
  double t = 0;  ///< on the second
  Vec3 on_first;
  Vec3 on_second;
};

/// The lines' nearest points by cross products (their relative error goes with the inverse of the
/// sine of the angle, that of the usual products of lengths with its square), then each clamped
/// point is moved to the foot of the other: along a valley of nearly parallel segments the
/// parameter is uncertain and the distance is not.
[[nodiscard]] inline SegmentPair nearest_points(const Segment& a, const Segment& b) noexcept {
  const Vec3 across = cross(a.along, b.along);
  const double squared = squared_length(across);
  SegmentPair pair;
  if (squared > 0) pair.s = unit_clamp(dot(cross(b.tail - a.tail, b.along), across) / squared);
  pair.t = nearest_on(b, a.at(pair.s));
  pair.s = nearest_on(a, b.at(pair.t));
  pair.on_first = a.at(pair.s);
  pair.on_second = b.at(pair.t);
  return pair;
}

}  // namespace carpus::convex
