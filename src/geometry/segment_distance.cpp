// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/segment_distance.hpp"

namespace carpus {
namespace {

double held_to_unit(double t) noexcept { return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t; }

}  // namespace

NearestOnSegments nearest_on_segments(const Vec3& a0,
                                      const Vec3& a1,
                                      const Vec3& b0,
                                      const Vec3& b1) noexcept {
  const Vec3 u = a1 - a0;
  const Vec3 v = b1 - b0;
  const Vec3 w = a0 - b0;
  const double a = dot(u, u);
  const double e = dot(v, v);
  const double f = dot(v, w);
  double s = 0.0;
  double t = 0.0;
  if (!(a > 0.0)) {
    t = e > 0.0 ? held_to_unit(f / e) : 0.0;
  } else {
    const double c = dot(u, w);
    if (!(e > 0.0)) {
      s = held_to_unit(-c / a);
    } else {
      const double b = dot(u, v);
      const double denominator = a * e - b * b;
      s = denominator > 0.0 ? held_to_unit((b * f - c * e) / denominator) : 0.0;
      t = (b * s + f) / e;
      if (t < 0.0) {
        t = 0.0;
        s = held_to_unit(-c / a);
      } else if (t > 1.0) {
        t = 1.0;
        s = held_to_unit((b - c) / a);
      }
    }
  }
  return {s, t};
}

double segment_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) noexcept {
  const NearestOnSegments at = nearest_on_segments(a0, a1, b0, b1);
  return distance(a0 + (a1 - a0) * at.a, b0 + (b1 - b0) * at.b);
}

}  // namespace carpus
