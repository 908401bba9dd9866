// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The line is cut by the planes of the rod's ends and by the cylinder of its largest radius: a
// quadratic. What is left is metal where the rod is plain; where it tapers, is hollow or carries a
// thread, it is sampled, each sample weighted by how far it lies inside, so that edges stay smooth.
#include "fluoroscopy/metal.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr double kSampleMm = 0.05;
constexpr double kMaxSamples = 2000.0;  ///< bounds a line along the axis of a long rod

/// An interval of the line's parameter [mm from `from`]; empty when low >= high.
struct Interval {
  double low;
  double high;
};

/// Where the line p + t u (relative to the rod's start, u and axis unit) is inside the cylinder.
Interval inside_cylinder(const Vec3& p, const Vec3& u, const Vec3& axis, double radius) noexcept {
  const Vec3 p_across = p - axis * dot(p, axis);
  const Vec3 u_across = u - axis * dot(u, axis);
  const double a = dot(u_across, u_across);
  const double b = dot(p_across, u_across);
  const double c = dot(p_across, p_across) - radius * radius;
  constexpr double kParallel = 1e-14;  // squared sine below which the line never leaves sideways
  if (a < kParallel) return c < 0 ? Interval{-1e9, 1e9} : Interval{1, 0};
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return {1, 0};
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

/// Where it is between the two end planes.
Interval between_ends(const Vec3& p, const Vec3& u, const Vec3& axis, double rod_length) noexcept {
  const double s = dot(p, axis);
  const double ds = dot(u, axis);
  if (std::abs(ds) < 1e-12) {
    return s >= 0 && s <= rod_length ? Interval{-1e9, 1e9} : Interval{1, 0};
  }
  const double a = -s / ds;
  const double b = (rod_length - s) / ds;
  return {std::min(a, b), std::max(a, b)};
}

/// How much of a sample at `q` (relative to the rod's start) is metal, 0 to 1.
double metal_at(const MetalCylinder& rod,
                const Vec3& q,
                const Vec3& axis,
                const Vec3& side,
                double rod_length) noexcept {
  const double s = dot(q, axis);
  const Vec3 across = q - axis * s;
  const double rho = length(across);
  double outer = rod.start_radius_mm + (rod.end_radius_mm - rod.start_radius_mm) * s / rod_length;
  if (rod.thread_depth_mm > 0 && rod.thread_pitch_mm > 0) {
    const double angle = std::atan2(dot(across, cross(axis, side)), dot(across, side));
    const double turn = s / rod.thread_pitch_mm - angle / (2 * kPi);
    const double phase = turn - std::floor(turn);
    outer -= rod.thread_depth_mm * std::min(1.0, 3.0 * std::min(phase, 1.0 - phase));
  }
  const double filled = std::clamp((outer - rho) / kSampleMm + 0.5, 0.0, 1.0);
  const double hollow = rod.bore_radius_mm > 0
                            ? std::clamp((rod.bore_radius_mm - rho) / kSampleMm + 0.5, 0.0, 1.0)
                            : 0.0;
  return std::max(0.0, filled - hollow);
}

}  // namespace

double line_integral(const MetalCylinder& rod, const Vec3& from, const Vec3& to) noexcept {
  const double rod_length = distance(rod.start, rod.end);
  const double radius = std::max(rod.start_radius_mm, rod.end_radius_mm);
  const double line_length = distance(from, to);
  if (!(rod_length > 0 && radius > 0 && line_length > 0)) return 0.0;
  const Vec3 axis = (rod.end - rod.start) / rod_length;
  const Vec3 u = (to - from) / line_length;
  const Vec3 p = from - rod.start;

  const Interval sides = inside_cylinder(p, u, axis, radius);
  const Interval ends = between_ends(p, u, axis, rod_length);
  const double low = std::max({0.0, sides.low, ends.low});
  const double high = std::min({line_length, sides.high, ends.high});
  if (!(low < high)) return 0.0;

  const bool plain = rod.start_radius_mm == rod.end_radius_mm && !(rod.bore_radius_mm > 0) &&
                     !(rod.thread_depth_mm > 0);
  if (plain) return rod.attenuation_per_mm * (high - low);
  const double samples = std::min(kMaxSamples, std::ceil((high - low) / kSampleMm));
  const double step = (high - low) / samples;
  const Vec3 side = any_perpendicular(axis);
  double metal = 0.0;
  for (int i = 0; i < static_cast<int>(samples); ++i) {
    metal += metal_at(rod, p + u * (low + (i + 0.5) * step), axis, side, rod_length);
  }
  return rod.attenuation_per_mm * metal * step;
}

}  // namespace carpus::fluoroscopy
