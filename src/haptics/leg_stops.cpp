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

using firmware::LegStopSide;

namespace {

/// How far a leg yields that bears `torque` [N mm], beside the servo's dead band; a stop bears it
/// one way only.
double yielded_rad(double torque, const LegYield& yield) noexcept {
  if (!(torque > 0)) return 0;
  const double turned = std::max(0.0, torque - yield.friction_n_mm) / yield.servo_n_mm_per_rad;
  return torque / yield.pad_n_mm_per_rad + turned;
}

}  // namespace

/// The way along the normal is the legs' work over the press.
double early_mm(const firmware::DeltaState<double>& state,
                const Vec3& normal,
                const arm::LegAngles& weight_n_mm,
                const LegYield& yield) noexcept {
  const Vec3 press = normal * kEarlyForPressN;
  double torques[3];
  firmware::delta_torques(state, firmware::Vector<double>{press.x, press.y, press.z}, torques);
  double work_n_mm = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double torque = std::abs(torques[i]);
    const double weight = torques[i] < 0 ? -weight_n_mm[i] : weight_n_mm[i];
    work_n_mm +=
        torque * 0.5 *
        (yielded_rad(torque + weight, yield) + yield.dead_band_rad + yielded_rad(weight, yield));
  }
  return std::min(work_n_mm / kEarlyForPressN, kMostEarlyMm);
}

firmware::Stop LegStops::free() noexcept {
  sides_ = {};
  return firmware::Stop();
}

firmware::Stop LegStops::at(const arm::DeltaArm& arm,
                            const SurfacePlane& plane,
                            const arm::LegAngles& angles,
                            const Vec3& tip,
                            const Vec3& velocity) noexcept {
  const double height = dot(plane.normal, tip) - plane.offset_mm;
  if (!is_finite(velocity) || !(height < kNearSurfaceMm)) return free();
  const Vec3 slide = velocity - plane.normal * dot(plane.normal, velocity);
  const auto here = firmware::delta_forward(arm.size, angles.data());
  if (!here.is_valid) return free();
  const double early =
      early_mm(here, plane.normal, arm::weight_left(arm, angles, arm::kStopArmWeight));
  const Vec3 place = tip - plane.normal * (height - early) + slide * kSlideLeadS;
  const auto on_surface = arm::inverse(arm, place);
  if (!on_surface) return free();
  const auto state = firmware::delta_forward(arm.size, on_surface->data());
  if (!state.is_valid) return free();
  std::array<double, 3> turns{};
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 rod{state.rods[i].x, state.rods[i].y, state.rods[i].z};
    turns[i] = dot(rod, plane.normal) / state.levers[i];
    most = std::max(most, std::abs(turns[i]));
  }
  firmware::Stop stop;
  for (std::size_t i = 0; i < 3; ++i) {
    double wall = (*on_surface)[i];
    if (!(std::abs(turns[i]) > kLeastTurnShare * most) || !std::isfinite(wall)) {
      sides_[i] = LegStopSide::Free;
      continue;
    }
    const bool is_below = turns[i] > 0;
    const LegStopSide side = is_below ? LegStopSide::NotBelow : LegStopSide::NotAbove;
    const double sign = is_below ? 1 : -1;
    // Past its old stop by so much, to the open side.
    const double away = sign * (angles[i] - stops_[i]);
    if (sides_[i] == side && !(away > kLeansRad))
      wall = sign * std::min(sign * wall, sign * stops_[i]);
    stops_[i] = wall;
    sides_[i] = side;
    stop.legs[i].side = side;
    // The horn is what has to stand right, and it knows no potentiometer: so the true angle, not
    // the one of the firmware's straight line.
    stop.legs[i].angle = static_cast<std::int16_t>(
        std::lround(std::clamp(wall / kRadPerUnit, -kMostUnits, kMostUnits)));
  }
  return stop;
}

}  // namespace carpus::haptics
