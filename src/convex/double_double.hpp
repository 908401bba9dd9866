// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of twice the digits, as unevaluated sums of two doubles, by + - * / alone (the same bytes
// everywhere; long double is not). Relative error of an operation: a few 2^-104.
// Sources: [dekker1971], [shewchuk1997predicates] §2.
#pragma once

#include "geometry/vec3.hpp"

namespace carpus::convex {

struct DoubleDouble {
  double high = 0;
  double low = 0;  ///< at most half a unit in the last place of `high`

  constexpr DoubleDouble() noexcept = default;
  // A double is one of these: formulas mix both.
  constexpr DoubleDouble(double value) noexcept : high(value) {}  // NOLINT(*-explicit-*)
  constexpr DoubleDouble(double h, double l) noexcept : high(h), low(l) {}

  /// a + b exactly.
  [[nodiscard]] static constexpr DoubleDouble sum(double a, double b) noexcept {
    const double s = a + b;
    const double bb = s - a;
    return {s, (a - (s - bb)) + (b - bb)};
  }
  /// The same for |a| >= |b|.
  [[nodiscard]] static constexpr DoubleDouble ordered_sum(double a, double b) noexcept {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  /// a * b exactly, for magnitudes below 1e290 whose product does not underflow.
  [[nodiscard]] static constexpr DoubleDouble product(double a, double b) noexcept {
    const double p = a * b;
    constexpr double kSplit = 0x1.0p27 + 1;
    const double ca = kSplit * a;
    const double ah = ca - (ca - a);
    const double al = a - ah;
    const double cb = kSplit * b;
    const double bh = cb - (cb - b);
    const double bl = b - bh;
    return {p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
  }

  friend constexpr DoubleDouble operator-(const DoubleDouble& a) noexcept {
    return {-a.high, -a.low};
  }
  friend constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const DoubleDouble s = sum(a.high, b.high);
    const DoubleDouble t = sum(a.low, b.low);
    const DoubleDouble u = ordered_sum(s.high, s.low + t.high);
    return ordered_sum(u.high, u.low + t.low);
  }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return a + (-b);
  }
  friend constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const DoubleDouble p = product(a.high, b.high);
    return ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  friend constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const double q1 = a.high / b.high;
    const DoubleDouble r = a - b * DoubleDouble(q1);
    const double q2 = r.high / b.high;
    const DoubleDouble r2 = r - b * DoubleDouble(q2);
    const DoubleDouble q = ordered_sum(q1, q2);
    return q + DoubleDouble(r2.high / b.high);
  }
  friend constexpr bool operator<(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }
  friend constexpr bool operator>(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return b < a;
  }
};

/// Vec3 with twice the digits, as far as the simplex needs it.
struct WideVec3 {
  DoubleDouble x;
  DoubleDouble y;
  DoubleDouble z;

  constexpr WideVec3() noexcept = default;
  constexpr WideVec3(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c) noexcept
      : x(a), y(b), z(c) {}
  constexpr explicit WideVec3(const Vec3& v) noexcept : x(v.x), y(v.y), z(v.z) {}

  [[nodiscard]] constexpr Vec3 rounded() const noexcept { return {x.high, y.high, z.high}; }
  friend constexpr WideVec3 operator+(const WideVec3& a, const WideVec3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr WideVec3 operator-(const WideVec3& a, const WideVec3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr WideVec3 operator-(const WideVec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
  friend constexpr WideVec3 operator*(const WideVec3& a, const DoubleDouble& s) noexcept {
    return {a.x * s, a.y * s, a.z * s};
  }
};

[[nodiscard]] constexpr DoubleDouble dot(const WideVec3& a, const WideVec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr WideVec3 cross(const WideVec3& a, const WideVec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace carpus::convex
