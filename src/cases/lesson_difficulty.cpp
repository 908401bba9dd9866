// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/lesson_difficulty.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::cases {
namespace {

/// Bone left at both ends of a screw, together [clinical: B1].
constexpr double kLeftAtEndsMm = 4.0;

/// 0 at `easy`, 1 at `hard`, in between in proportion.
double between(double value, double easy, double hard) {
  return std::clamp((value - easy) / (hard - easy), 0.0, 1.0);
}

/// Length of the axis on the shorter side of the fracture; all of it where there is none.
double smaller_part(const AxisSegment& axis, const std::optional<FractureFacts>& fracture) {
  const Vec3 whole = axis.distal - axis.proximal;
  const double slope = fracture ? dot(fracture->normal, whole) : 0;
  if (std::abs(slope) < 1e-9) return length(whole);
  const double share =
      std::clamp(dot(fracture->normal, fracture->point - axis.proximal) / slope, 0.0, 1.0);
  return std::min(share, 1 - share) * length(whole);
}

}  // namespace

Difficulty difficulty_of(const ScaphoidLandmarks& scaphoid,
                         const std::optional<FractureFacts>& fracture,
                         double screw_radius_mm) {
  Difficulty d;
  const AxisSegment& axis = scaphoid.central_axis;
  d.corridor_clearance_mm = scaphoid.central_radius_mm - screw_radius_mm;
  d.corridor_length_mm = std::max(0.0, length(axis.distal - axis.proximal) - kLeftAtEndsMm);
  d.smaller_part_mm = smaller_part(axis, fracture);
  if (fracture) {
    d.gap_mm = fracture->gap_mm;
    d.step_mm = fracture->step_mm;
    d.flexion_deg = fracture->flexion_deg;
  }
  d.overall = 40 * between(d.corridor_clearance_mm, 2.0, 0.3) +
              30 * between(d.smaller_part_mm, 12, 4) + 10 * between(d.corridor_length_mm, 24, 14) +
              20 * std::max({between(d.gap_mm, 1, 2.5), between(d.step_mm, 0.5, 2),
                             between(d.flexion_deg, 3, 20)});
  return d;
}

}  // namespace carpus::cases
