// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/leg_stops.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "firmware/core/delta.hpp"

namespace carpus::haptics {
namespace {
constexpr double kRadPerUnit = kPi / 8192;
constexpr double kMostUnits = 8191;
}  // namespace

firmware::Stop leg_stops(const arm::DeltaArm& arm,
                         const std::array<arm::LegCalibration, 3>& calibrations,
                         const SurfacePlane& plane,
                         const Vec3& tip,
                         const Vec3& velocity) noexcept {
  firmware::Stop stop;  // all free
  const double height = dot(plane.normal, tip) - plane.offset_mm;
  if (!is_finite(velocity) || !(height < kNearSurfaceMm)) return stop;
  const Vec3 slide = velocity - plane.normal * dot(plane.normal, velocity);
  const Vec3 place = tip - plane.normal * height + slide * kSlideLeadS;
  const auto angles = arm::inverse(arm, place);
  if (!angles) return stop;
  const auto state = firmware::delta_forward(arm.size, angles->data());
  if (!state.is_valid) return stop;
  std::array<double, 3> turns{};
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 rod{state.rods[i].x, state.rods[i].y, state.rods[i].z};
    turns[i] = dot(rod, plane.normal) / state.levers[i];
    most = std::max(most, std::abs(turns[i]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(turns[i]) > kLeastTurnShare * most)) continue;
    const double units = calibrations[i].line_angle_at((*angles)[i]) / kRadPerUnit;
    if (!std::isfinite(units)) continue;
    stop.legs[i].side =
        turns[i] > 0 ? firmware::LegStopSide::NotBelow : firmware::LegStopSide::NotAbove;
    stop.legs[i].angle =
        static_cast<std::int16_t>(std::lround(std::clamp(units, -kMostUnits, kMostUnits)));
  }
  return stop;
}

}  // namespace carpus::haptics
