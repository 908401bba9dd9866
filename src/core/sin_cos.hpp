// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Sine and cosine from + - * / alone, for the tick: the same bits on every machine, which the
// standard library does not promise.
#pragma once

namespace carpus {

struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

/// Of an angle in [-360, 360] degrees, within 1e-13: reduced to an eighth of a turn, then the
/// series of Taylor to the power of 15 and 14.
[[nodiscard]] constexpr SinCos sin_cos_deg(double angle_deg) noexcept {
  int quarter = 0;
  while (angle_deg > 45.0) {
    angle_deg -= 90.0;
    ++quarter;
  }
  while (angle_deg < -45.0) {
    angle_deg += 90.0;
    --quarter;
  }
  constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
  const double x = angle_deg * kRadPerDeg;
  const double x2 = x * x;
  double sin = 0.0;
  double cos = 0.0;
  for (int n = 14; n >= 2; n -= 2) {
    sin = (1.0 + sin) * (-x2 / (n * (n + 1)));
    cos = (1.0 + cos) * (-x2 / (n * (n - 1)));
  }
  sin = x * (1.0 + sin);
  cos = 1.0 + cos;
  switch (quarter & 3) {
    case 1:
      return {cos, -sin};
    case 2:
      return {-sin, -cos};
    case 3:
      return {-cos, sin};
    default:
      return {sin, cos};
  }
}

}  // namespace carpus
