// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The little mathematics that the firmware needs, for float on the device and double on the host.
// Only
// + - * / and the square root, so that both give the same bits everywhere.
#pragma once

#include <stdint.h>

namespace carpus {
namespace firmware {

inline float root(float x) { return __builtin_sqrtf(x); }
inline double root(double x) { return __builtin_sqrt(x); }

template <typename Real>
Real absolute(Real x) {
  return x < Real(0) ? -x : x;
}
/// Not-a-number becomes `low`.
template <typename Real>
Real clamped(Real x, Real low, Real high) {
  if (!(x > low)) return low;
  return x < high ? x : high;
}

template <typename Real>
struct SinCos {
  Real sin;
  Real cos;
};

/// For |angle| up to some turns. Series of Taylor on an eighth of a turn, to 1e-7 as float and,
/// with two more terms, 1e-13 as double.
template <typename Real>
SinCos<Real> sin_cos(Real angle) {
  constexpr Real kQuarter = Real(1.57079632679489661923);
  const Real turns = angle / kQuarter;
  const int32_t quarter = static_cast<int32_t>(turns + (turns < Real(0) ? Real(-0.5) : Real(0.5)));
  const Real r = angle - static_cast<Real>(quarter) * kQuarter;
  const Real q = r * r;
  // 1/(n (n + 1)) from the innermost term outwards.
  Real s = Real(1);
  Real c = Real(1);
  for (int8_t n = sizeof(Real) == 4 ? 8 : 16; n >= 2; n = static_cast<int8_t>(n - 2)) {
    s = Real(1) - s * q / Real(n * (n + 1));
    c = Real(1) - c * q / Real(n * (n - 1));
  }
  s = s * r;
  switch (static_cast<uint32_t>(quarter) & 3U) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

template <typename Real>
struct Vector {
  Real x = Real(0);
  Real y = Real(0);
  Real z = Real(0);

  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(Vector a, Real s) { return {a.x * s, a.y * s, a.z * s}; }

  Vector() = default;
  Vector(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
};

template <typename Real>
Real dot(Vector<Real> a, Vector<Real> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Real>
Vector<Real> cross(Vector<Real> a, Vector<Real> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename Real>
Real length(Vector<Real> a) {
  return root(dot(a, a));
}

}  // namespace firmware
}  // namespace carpus
