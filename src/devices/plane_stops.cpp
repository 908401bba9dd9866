// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/plane_stops.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::devices {
namespace {

constexpr double kUnitsPerRad = 8192 / kPi;
constexpr double kSmallStepMm = 0.5;

std::int16_t units_of(double angle) noexcept {
  return static_cast<std::int16_t>(std::lround(std::clamp(angle * kUnitsPerRad, -8191.0, 8191.0)));
}

/// The plane that matters most now; none within reach: nullptr.
const LocalPlane* nearest(const Vec3& tip, const DeviceCommand& command) noexcept {
  const LocalPlane* best = nullptr;
  double least = kStopReachMm;
  for (std::size_t i = 0; i < std::min<std::size_t>(command.plane_count, kMostPlanes); ++i) {
    const LocalPlane& plane = command.planes[i];
    const double height = dot(plane.normal, tip) - plane.offset_mm;
    if (!(plane.stiffness_n_per_mm > 0) || !(height < least)) continue;
    least = height;
    best = &plane;
  }
  return best;
}

}  // namespace

firmware::Stop stops_of(const arm::DeltaArm& arm,
                        const std::array<arm::LegCalibration, kLegs>& legs,
                        const Vec3& tip,
                        const DeviceCommand& command) noexcept {
  firmware::Stop stop;
  const LocalPlane* plane = command.limit_n > 0 ? nearest(tip, command) : nullptr;
  if (plane == nullptr) return stop;
  const Vec3 foot = tip - plane->normal * (dot(plane->normal, tip) - plane->offset_mm);
  const auto there = arm::inverse(arm, foot);
  const auto beyond = arm::inverse(arm, foot + plane->normal * kSmallStepMm);
  if (!there || !beyond) return stop;
  double most = 0;
  for (std::size_t i = 0; i < kLegs; ++i) {
    most = std::max(most, std::abs((*beyond)[i] - (*there)[i]));
  }
  for (std::size_t i = 0; i < kLegs; ++i) {
    const double turn = (*beyond)[i] - (*there)[i];
    if (std::abs(turn) < kLeastShareOfTurn * most) continue;
    const double line_angle = legs[i].line_angle_at((*there)[i]);
    // The firmware counts in its own line, whose sense is the leg's.
    stop.legs[i].angle = units_of(line_angle);
    stop.legs[i].side =
        turn > 0 ? firmware::LegStopSide::NotBelow : firmware::LegStopSide::NotAbove;
  }
  return stop;
}

}  // namespace carpus::devices
