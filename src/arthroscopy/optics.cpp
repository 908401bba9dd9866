// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/optics.hpp"

#include <cmath>
#include <cstdint>

#include "cases/hand_motion.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180;

/// The part of `v` across a unit vector, as a unit vector.
Vec3 across(const Vec3& v, const Vec3& unit) noexcept {
  return normalized_or(v - unit * dot(v, unit), any_perpendicular(unit));
}

/// A unit vector across `axis`, turned about it.
Vec3 turned(const Vec3& unit, const Vec3& axis, double angle_deg) noexcept {
  const auto [c, s] = cos_sin_deg(angle_deg);
  return unit * c + cross(axis, unit) * s;
}

}  // namespace

std::array<double, 2> cos_sin_deg(double angle_deg) noexcept {
  if (!(angle_deg > -1e6 && angle_deg < 1e6)) return {1, 0};
  const double turns = angle_deg / 90;
  const auto quarter = static_cast<std::int64_t>(turns < 0 ? turns - 0.5 : turns + 0.5);
  const cases::CosSin part =
      cases::cos_sin_of_small((angle_deg - 90.0 * static_cast<double>(quarter)) * kRadPerDeg);
  switch (((quarter % 4) + 4) % 4) {
    case 1:
      return {-part.sine, part.cosine};
    case 2:
      return {-part.cosine, -part.sine};
    case 3:
      return {part.sine, -part.cosine};
    default:
      return {part.cosine, part.sine};
  }
}

Sight sight_of(const Lens& lens, const ScopeHold& hold, const Vec3& level) noexcept {
  const Vec3 level_across = across(level, hold.shaft);
  const Vec3 side = turned(level_across, hold.shaft, hold.shaft_turn_deg);
  const auto [along, aside] = cos_sin_deg(lens.view_angle_deg);
  Sight sight;
  sight.eye = hold.tip;
  sight.axis = side * aside - hold.shaft * along;
  sight.up = across(turned(level_across, hold.shaft, hold.camera_turn_deg), sight.axis);
  sight.right = cross(sight.axis, sight.up);
  sight.least_cosine = cos_sin_deg(lens.field_deg / 2)[0];
  return sight;
}

bool is_in_field(const Sight& sight, const Vec3& point) noexcept {
  const Vec3 to = point - sight.eye;
  return dot(to, sight.axis) >= sight.least_cosine * length(to);
}

double horizon_cosine(const Sight& sight, const Vec3& level) noexcept {
  const Vec3 true_up = level - sight.axis * dot(level, sight.axis);
  const double far = length(true_up);
  return far > 1e-9 ? dot(true_up, sight.up) / far : 1.0;
}

std::optional<Pixel> project(const Lens& lens,
                             const Sight& sight,
                             double diameter_px,
                             const Vec3& point) {
  const Vec3 to = point - sight.eye;
  const double x = dot(to, sight.right);
  const double y = dot(to, sight.up);
  const double aside = std::hypot(x, y);
  const double angle = std::atan2(aside, dot(to, sight.axis));
  const double half = lens.field_deg / 2 * kRadPerDeg;
  if (!(angle <= half)) return std::nullopt;
  if (!(aside > 0)) return Pixel{};
  const double r = diameter_px / 2 * angle / half;
  return Pixel{r * x / aside, -r * y / aside};
}

}  // namespace carpus::arthroscopy
