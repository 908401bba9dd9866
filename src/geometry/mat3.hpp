// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 3 x 3 matrix, row-major, with arithmetic in a written order (see vec3.hpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/vec3.hpp"

namespace carpus {

struct Mat3 {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  [[nodiscard]] static constexpr Mat3 identity() noexcept { return {}; }
  [[nodiscard]] static constexpr Mat3 from_columns(const Vec3& a,
                                                   const Vec3& b,
                                                   const Vec3& c) noexcept {
    return {{Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}}};
  }
  [[nodiscard]] constexpr Vec3 column(std::size_t i) const noexcept {
    return {rows[0][i], rows[1][i], rows[2][i]};
  }
  [[nodiscard]] constexpr Mat3 transposed() const noexcept {
    return {{column(0), column(1), column(2)}};
  }
  [[nodiscard]] constexpr double determinant() const noexcept {
    return dot(rows[0], cross(rows[1], rows[2]));
  }
  constexpr bool operator==(const Mat3&) const = default;

  friend constexpr Vec3 operator*(const Mat3& m, const Vec3& v) noexcept {
    return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
  }
  friend constexpr Mat3 operator*(const Mat3& a, const Mat3& b) noexcept {
    const Mat3 bt = b.transposed();
    return {{bt * a.rows[0], bt * a.rows[1], bt * a.rows[2]}};
  }
};

/// Rotation by `angle_rad` about the unit vector `axis`, right-handed (Rodrigues). Uses sin and
/// cos: never call it in World::step.
[[nodiscard]] inline Mat3 rotation_about(const Vec3& axis, double angle_rad) noexcept {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  const double k = 1.0 - c;
  const auto [x, y, z] = axis;
  return {{Vec3{c + x * x * k, x * y * k - z * s, x * z * k + y * s},
           Vec3{y * x * k + z * s, c + y * y * k, y * z * k - x * s},
           Vec3{z * x * k - y * s, z * y * k + x * s, c + z * z * k}}};
}

/// Rotation matrix of the quaternion (w, x, y, z), normalised first; it must not be zero.
[[nodiscard]] inline Mat3 rotation_from_quaternion(double w,
                                                   double x,
                                                   double y,
                                                   double z) noexcept {
  const double n = std::sqrt(w * w + x * x + y * y + z * z);
  w /= n;
  x /= n;
  y /= n;
  z /= n;
  return {{Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           Vec3{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           Vec3{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

}  // namespace carpus
