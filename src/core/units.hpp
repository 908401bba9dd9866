// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Strong types for API boundaries. Inside C++ everything is mm, N, s, rad and HU; inner loops use
// double with the unit in the name (`depth_mm`).
#pragma once

#include <compare>
#include <cstdint>
#include <numbers>

namespace carpus {

/// A number with a unit; built explicitly, compared and scaled, never mixed.
template <typename Unit>
struct Quantity {
  double value = 0.0;

  constexpr Quantity() = default;
  constexpr explicit Quantity(double v) : value(v) {}
  constexpr auto operator<=>(const Quantity&) const = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(a.value + b.value);
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(a.value - b.value);
  }
  friend constexpr Quantity operator*(Quantity a, double s) { return Quantity(a.value * s); }
  friend constexpr Quantity operator*(double s, Quantity a) { return Quantity(a.value * s); }
};

using Millimeters = Quantity<struct MillimeterUnit>;
using Newtons = Quantity<struct NewtonUnit>;
using Seconds = Quantity<struct SecondUnit>;
using Radians = Quantity<struct RadianUnit>;
using HounsfieldUnits = Quantity<struct HounsfieldUnit>;

/// Number of simulation steps since the exercise began; one tick is 1 ms.
using Tick = std::uint64_t;
inline constexpr double kTickSeconds = 0.001;

/// 1 N = 1000 kg mm/s^2: the one place where this conversion is written.
inline constexpr double kKilogramMillimeterPerSecond2PerNewton = 1000.0;

inline constexpr double kPi = std::numbers::pi;
[[nodiscard]] constexpr double radians_from_degrees(double degrees) {
  return degrees * (kPi / 180.0);
}
[[nodiscard]] constexpr double degrees_from_radians(double radians) {
  return radians * (180.0 / kPi);
}

}  // namespace carpus
