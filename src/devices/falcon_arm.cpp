// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/falcon_arm.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::devices {
namespace {

constexpr double kA = 60;
constexpr double kB = 102.5;
constexpr double kC = 14;
constexpr double kEnds = 11.25 + 11.25;
constexpr double kF = -25;
constexpr double kS = -27.330909;
constexpr double kR = 37.233758;
constexpr double kPhi[] = {kPi / 2, -kPi / 6, -5 * kPi / 6};
/// Four counts a slot of 320, a shaft of 14.25 mm on an arc of 110 mm.
constexpr double kRadPerCount = 2 * kPi * 14.25 / (320.0 * 4 * 110);
constexpr double kZeroRad = 35 * kPi / 180;

struct InLeg {
  double u, v, w;
};
InLeg in_leg(const Vec3& p, std::size_t leg) noexcept {
  const double c = std::cos(kPhi[leg]);
  const double s = std::sin(kPhi[leg]);
  return {p.x * c + p.y * s - kR, -p.x * s + p.y * c - kS, p.z};
}

/// What of the rod is left in the leg's plane; none where it is too short.
std::optional<double> reach(const InLeg& at) noexcept {
  const double rest = kB * kB - (at.v + kF) * (at.v + kF);
  if (!(rest > 0)) return std::nullopt;
  return kEnds + std::sqrt(rest);
}

/// The constraint of one leg, its slope with the tip (in the world's axes) and with its angle.
struct Constraint {
  double value = 0;
  Vec3 by_tip;
  double by_angle = 0;
  bool is_valid = false;
};
Constraint constraint(const Vec3& tip, double angle, std::size_t leg) noexcept {
  Constraint out;
  const InLeg at = in_leg(tip, leg);
  const auto length = reach(at);
  if (!length) return out;
  const double du = at.u + kC - kA * std::cos(angle);
  const double dw = at.w - kA * std::sin(angle);
  out.value = du * du + dw * dw - *length * *length;
  // d(length)/dv = -(v + f) / (length - ends)
  const double by_v = 2 * *length * (at.v + kF) / (*length - kEnds);
  const double c = std::cos(kPhi[leg]);
  const double s = std::sin(kPhi[leg]);
  out.by_tip = {2 * du * c - by_v * s, 2 * du * s + by_v * c, 2 * dw};
  out.by_angle = 2 * kA * (du * std::sin(angle) - dw * std::cos(angle));
  out.is_valid = true;
  return out;
}

}  // namespace

double falcon_angle(std::int16_t counts) noexcept { return counts * kRadPerCount + kZeroRad; }

std::int16_t falcon_counts(double angle) noexcept {
  return static_cast<std::int16_t>(
      std::lround(std::clamp((angle - kZeroRad) / kRadPerCount, -32767.0, 32767.0)));
}

std::optional<FalconAngles> falcon_inverse(const Vec3& tip) noexcept {
  FalconAngles angles{};
  for (std::size_t i = 0; i < 3; ++i) {
    const InLeg at = in_leg(tip, i);
    const auto length = reach(at);
    if (!length) return std::nullopt;
    const double u = at.u + kC;
    const double far = std::hypot(u, at.w);
    const double g = (far * far + kA * kA - *length * *length) / (2 * kA * far);
    if (!(std::abs(g) <= 1)) return std::nullopt;
    // The knee is outside of the rod.
    angles[i] = std::atan2(at.w, u) - std::acos(g);
  }
  return angles;
}

std::optional<Vec3> falcon_forward(const FalconAngles& angles, const Vec3& near) noexcept {
  constexpr int kMostSteps = 20;
  constexpr double kCloseMm = 1e-6;
  constexpr double kMostStepMm = 30;
  Vec3 tip = near;
  for (int step = 0; step < kMostSteps; ++step) {
    std::array<Constraint, 3> of;
    for (std::size_t i = 0; i < 3; ++i) {
      of[i] = constraint(tip, angles[i], i);
      if (!of[i].is_valid) return std::nullopt;
    }
    const Vec3& a = of[0].by_tip;
    const Vec3& b = of[1].by_tip;
    const Vec3& c = of[2].by_tip;
    const double volume = dot(a, cross(b, c));
    if (!(std::abs(volume) > 1)) return std::nullopt;
    Vec3 move =
        (cross(b, c) * of[0].value + cross(c, a) * of[1].value + cross(a, b) * of[2].value) /
        -volume;
    const double size = length(move);
    if (!(size < 1e6)) return std::nullopt;
    if (size > kMostStepMm) move *= kMostStepMm / size;
    tip += move;
    if (size < kCloseMm) return tip;
  }
  return std::nullopt;
}

std::optional<FalconAngles> falcon_torques(const Vec3& tip,
                                           const FalconAngles& angles,
                                           const Vec3& force) noexcept {
  // by_tip_i . v + by_angle_i t_i' = 0, so F = sum of by_tip_i l_i with t_i = -by_angle_i l_i.
  std::array<Constraint, 3> of;
  for (std::size_t i = 0; i < 3; ++i) {
    of[i] = constraint(tip, angles[i], i);
    if (!of[i].is_valid) return std::nullopt;
  }
  const double volume = dot(of[0].by_tip, cross(of[1].by_tip, of[2].by_tip));
  if (!(std::abs(volume) > 1)) return std::nullopt;
  FalconAngles torques{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 across = cross(of[(i + 1) % 3].by_tip, of[(i + 2) % 3].by_tip);
    torques[i] = -of[i].by_angle * dot(across, force) / volume;
  }
  return torques;
}

}  // namespace carpus::devices
