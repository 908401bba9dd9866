// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/views.hpp"

#include <array>
#include <cstddef>

namespace carpus::procedure {
namespace {

constexpr double kToleranceDeg = 15.0;     // how far from its nominal angle a view may be taken
constexpr double kProximalTiltDeg = 20.0;  // the skyline view is a 30 degree one [skyline2021]

bool near(double value, double nominal) noexcept {
  return value >= nominal - kToleranceDeg && value <= nominal + kToleranceDeg;
}

/// In (-90, 90]: a picture from the other side shows the same contours.
double folded(double rotation_deg) noexcept {
  if (rotation_deg > 90) return rotation_deg - 180;
  if (rotation_deg <= -90) return rotation_deg + 180;
  return rotation_deg;
}

}  // namespace

std::string_view name_of(View view) noexcept {
  static constexpr std::array<std::string_view, kViewCount> kNames{
      "pa", "lateral", "pronated_oblique", "proximal_pole"};
  const auto index = static_cast<std::size_t>(view);
  return index < kNames.size() ? kNames[index] : std::string_view{"unknown"};
}

bool shows(View view, double rotation_deg, double tilt_deg) noexcept {
  const double rotation = folded(rotation_deg);
  const bool is_level = near(tilt_deg, 0);
  switch (view) {
    case View::Pa:
      return is_level && near(rotation, 0);
    case View::Lateral:
      return is_level && (near(rotation, 90) || near(rotation, -90));
    case View::PronatedOblique:
      return is_level && near(rotation, 45);
    case View::ProximalPole:
      return (tilt_deg >= kProximalTiltDeg || tilt_deg <= -kProximalTiltDeg) && near(rotation, 0);
  }
  return false;
}

}  // namespace carpus::procedure
