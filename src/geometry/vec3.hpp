// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A vector of three doubles with arithmetic in a written order, so that results are the same bytes
// on every machine and in WebAssembly (docs/decisions/0003-determinism.md says why not Eigen here).
#pragma once

#include <cmath>
#include <cstddef>

namespace carpus {

/// A position or a displacement [mm], or a direction [1]; the variable's name says which and in
/// which frame. For values that cross module borders see Point and Direction in geometry/pose.hpp.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  constexpr double& operator[](std::size_t i) noexcept { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr double operator[](std::size_t i) const noexcept {
    return i == 0 ? x : (i == 1 ? y : z);
  }
  constexpr bool operator==(const Vec3&) const = default;

  constexpr Vec3& operator+=(const Vec3& b) noexcept { return *this = {x + b.x, y + b.y, z + b.z}; }
  constexpr Vec3& operator-=(const Vec3& b) noexcept { return *this = {x - b.x, y - b.y, z - b.z}; }
  constexpr Vec3& operator*=(double s) noexcept { return *this = {x * s, y * s, z * s}; }
  friend constexpr Vec3 operator+(Vec3 a, const Vec3& b) noexcept { return a += b; }
  friend constexpr Vec3 operator-(Vec3 a, const Vec3& b) noexcept { return a -= b; }
  friend constexpr Vec3 operator-(const Vec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) noexcept { return a *= s; }
  friend constexpr Vec3 operator*(double s, Vec3 a) noexcept { return a *= s; }
  friend constexpr Vec3 operator/(const Vec3& a, double s) noexcept {
    return {a.x / s, a.y / s, a.z / s};
  }
};

[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] constexpr double squared_length(const Vec3& a) noexcept { return dot(a, a); }
[[nodiscard]] inline double length(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline double distance(const Vec3& a, const Vec3& b) noexcept {
  return length(a - b);
}

/// Unit vector along `a`, or `fallback` where `a` is too short (or not finite) to have a direction.
[[nodiscard]] inline Vec3 normalized_or(const Vec3& a, const Vec3& fallback) noexcept {
  const double n = length(a);
  return n > 1e-300 && n < 1e300 ? a / n : fallback;
}

/// Some unit vector perpendicular to the unit vector `axis`; continuous but for a switch of branch.
[[nodiscard]] inline Vec3 any_perpendicular(const Vec3& axis) noexcept {
  const Vec3 other = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized_or(cross(axis, other), Vec3{0, 0, 1});
}

[[nodiscard]] inline bool is_finite(const Vec3& a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace carpus
