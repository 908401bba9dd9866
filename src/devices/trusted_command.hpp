// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The last look at a command before a driver has it: what is no number becomes no force, what is
// too much becomes the most. A step of its own, so that no driver can forget it.
#pragma once

#include <algorithm>
#include <cmath>

#include "devices/device.hpp"

namespace carpus::devices {

/// Above this no device of ours is asked for anything: more than an expert's hand uses, less than
/// a wrist minds.
inline constexpr double kMostForceN = 8.0;
inline constexpr double kMostStiffnessNPerMm = 10.0;
inline constexpr double kMostDampingNSPerMm = 0.02;
inline constexpr double kMostVibrationN = 1.0;
inline constexpr double kMostVibrationHz = 500.0;
inline constexpr double kMostTorqueNMm = 300.0;
inline constexpr double kMostOffsetMm = 500.0;

/// @param faults  is raised where something was no number.
[[nodiscard]] inline DeviceCommand trusted(DeviceCommand command,
                                           const Capabilities& able,
                                           std::uint64_t& faults) noexcept {
  const double scalars =
      command.limit_n + command.vibration_n + command.vibration_hz + command.torque_n_mm;
  bool is_sound = is_finite(command.force_n) && std::isfinite(scalars);
  command.plane_count =
      std::min<std::uint8_t>(command.plane_count, static_cast<std::uint8_t>(kMostPlanes));
  for (std::size_t i = 0; i < command.plane_count; ++i) {
    LocalPlane& plane = command.planes[i];
    is_sound = is_sound && is_finite(plane.normal) && std::abs(length(plane.normal) - 1) < 1e-3 &&
               std::abs(plane.offset_mm) <= kMostOffsetMm &&
               std::isfinite(plane.stiffness_n_per_mm + plane.damping_n_s_per_mm + plane.friction);
    const double most =
        able.most_stiffness_n_per_mm > 0 ? able.most_stiffness_n_per_mm : kMostStiffnessNPerMm;
    plane.stiffness_n_per_mm =
        std::clamp(plane.stiffness_n_per_mm, 0.0, std::min(most, kMostStiffnessNPerMm));
    plane.damping_n_s_per_mm = std::clamp(plane.damping_n_s_per_mm, 0.0, kMostDampingNSPerMm);
    plane.friction = std::clamp(plane.friction, 0.0, 1.9);
  }
  if (!is_sound) {
    ++faults;
    return {};
  }
  const double most =
      able.peak_force_n > 0 ? std::min(able.peak_force_n, kMostForceN) : kMostForceN;
  command.limit_n = std::clamp(command.limit_n, 0.0, most);
  const double size = length(command.force_n);
  if (size > command.limit_n) command.force_n *= command.limit_n / size;
  command.vibration_n = std::clamp(command.vibration_n, 0.0, kMostVibrationN);
  command.vibration_hz = std::clamp(command.vibration_hz, 0.0, kMostVibrationHz);
  command.torque_n_mm = able.torque ? std::clamp(command.torque_n_mm, 0.0, kMostTorqueNMm) : 0.0;
  return command;
}

/// Of a slide [N s/mm]: below the friction that a press allows, a hand that hardly moves is hardly
/// held, so that rounding of a velocity is no force.
inline constexpr double kSlideDampingNSPerMm = 0.02;

/// What planes and force come to for a device that takes forces alone: spring and damper into each
/// plane, never a pull; friction against the slide, which takes work and gives none; limited last.
[[nodiscard]] inline Vec3 force_of(const DeviceCommand& command,
                                   const Vec3& position_mm,
                                   const Vec3& velocity_mm_s) noexcept {
  Vec3 force = command.force_n;
  for (std::size_t i = 0; i < std::min<std::size_t>(command.plane_count, kMostPlanes); ++i) {
    const LocalPlane& plane = command.planes[i];
    const double depth = plane.offset_mm - dot(plane.normal, position_mm);
    if (!(depth > 0)) continue;
    const double press = plane.stiffness_n_per_mm * depth -
                         plane.damping_n_s_per_mm * dot(plane.normal, velocity_mm_s);
    if (!(press > 0)) continue;
    force += plane.normal * press;
    const Vec3 slide = velocity_mm_s - plane.normal * dot(plane.normal, velocity_mm_s);
    const double speed = length(slide);
    if (!(speed > 0)) continue;
    const double rub = std::min(plane.friction * press, kSlideDampingNSPerMm * speed);
    force -= slide * (rub / speed);
  }
  const double size = length(force);
  if (!(size > 0)) return {};
  return size > command.limit_n ? force * (command.limit_n / size) : force;
}

}  // namespace carpus::devices
