// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Rigid motions between rigid motions: unit dual quaternions, blended linearly [kavan2008dual].
// Unlike a mean of matrices the blend is rigid, so that what bends between two bodies neither
// shrinks nor shears towards their joint. Only + - * / and sqrt.
#pragma once

#include <array>
#include <cmath>

#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

/// A quaternion as written: w + xi + yj + zk.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;

  [[nodiscard]] friend constexpr Quaternion operator*(const Quaternion& a,
                                                      const Quaternion& b) noexcept {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
};

[[nodiscard]] constexpr double dot(const Quaternion& a, const Quaternion& b) noexcept {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Of a rotation matrix; the component that is largest in magnitude is taken from the diagonal, so
/// that no angle loses figures.
[[nodiscard]] inline Quaternion quaternion_from_rotation(const Mat3& m) noexcept {
  const auto& [r0, r1, r2] = m.rows;
  const std::array<double, 4> squares{1 + r0.x + r1.y + r2.z, 1 + r0.x - r1.y - r2.z,
                                      1 - r0.x + r1.y - r2.z, 1 - r0.x - r1.y + r2.z};
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (squares[i] > squares[largest]) largest = i;
  }
  const double s = 0.5 / std::sqrt(squares[largest]);
  const double own = 0.5 * std::sqrt(squares[largest]);
  switch (largest) {
    case 0:
      return {own, (r2.y - r1.z) * s, (r0.z - r2.x) * s, (r1.x - r0.y) * s};
    case 1:
      return {(r2.y - r1.z) * s, own, (r0.y + r1.x) * s, (r0.z + r2.x) * s};
    case 2:
      return {(r0.z - r2.x) * s, (r0.y + r1.x) * s, own, (r1.z + r2.y) * s};
    default:
      return {(r1.x - r0.y) * s, (r0.z + r2.x) * s, (r1.z + r2.y) * s, own};
  }
}

/// A rigid motion x -> rotation * x + translation, in the form that can be blended.
struct DualQuaternion {
  Quaternion real;
  Quaternion dual{0, 0, 0, 0};
};

[[nodiscard]] inline DualQuaternion dual_quaternion(const Mat3& rotation,
                                                    const Vec3& translation) noexcept {
  const Quaternion real = quaternion_from_rotation(rotation);
  const Quaternion half{0, 0.5 * translation.x, 0.5 * translation.y, 0.5 * translation.z};
  return {real, half * real};
}

/// Adds weighted motions up; `moved` carries a point along their blend.
class RigidBlend {
 public:
  /// @param weight  >= 0; only ratios matter.
  void add(const DualQuaternion& motion, double weight) noexcept {
    // q and -q are the same motion: take the one nearer to what is there.
    const double w = dot(sum_.real, motion.real) < 0 ? -weight : weight;
    add_scaled(sum_.real, motion.real, w);
    add_scaled(sum_.dual, motion.dual, w);
  }

  /// The whole of another blend as one motion, with this weight.
  void add(const RigidBlend& other, double weight) noexcept {
    const double norm = std::sqrt(dot(other.sum_.real, other.sum_.real));
    if (!(norm > 0)) return;
    add(other.sum_, weight / norm);
  }

  /// `point` itself while nothing was added.
  [[nodiscard]] Vec3 moved(const Vec3& point) const noexcept {
    const double squared = dot(sum_.real, sum_.real);
    if (!(squared > 0)) return point;
    const Quaternion& r = sum_.real;
    const Quaternion& d = sum_.dual;
    // [kavan2008dual] alg. 1: rotate by the real part, then add the translation of the dual one.
    const Vec3 v{r.x, r.y, r.z};
    const Vec3 u{d.x, d.y, d.z};
    const Vec3 turned = point + cross(v, cross(v, point) + point * r.w) * (2.0 / squared);
    return turned + (u * r.w - v * d.w + cross(v, u)) * (2.0 / squared);
  }

 private:
  static void add_scaled(Quaternion& to, const Quaternion& q, double s) noexcept {
    to.w += s * q.w;
    to.x += s * q.x;
    to.y += s * q.y;
    to.z += s * q.z;
  }

  DualQuaternion sum_{{0, 0, 0, 0}, {0, 0, 0, 0}};
};

}  // namespace carpus
