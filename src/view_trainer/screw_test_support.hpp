// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Screws in the synthetic wrist's scaphoid, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "cases/make_hand_motion.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "view_trainer/scaphoid_surface.hpp"

namespace carpus::view_trainer::test {

[[nodiscard]] inline const cases::CaseData& wrist() {
  static const cases::CaseData data = [] {
    cases::CaseData made = cases::test::synthetic_case();
    cases::ensure_hand_motion(made);
    return made;
  }();
  return data;
}

[[nodiscard]] inline cases::Bone& scaphoid_of(cases::CaseData& data) {
  return *std::find_if(data.bones.begin(), data.bones.end(),
                       [](const cases::Bone& bone) { return bone.bone == BoneId::Scaphoid; });
}

/// The same with a scaphoid that is 2.6 mm thick at its waist: a screw comes out at its sides.
[[nodiscard]] inline cases::CaseData wrist_with_a_narrow_waist() {
  cases::CaseData data = wrist();
  const cases::test::Ellipsoid body = cases::test::synthetic_scaphoid();
  const Vec3 along = body.rotation.column(2);
  for (Vec3& v : scaphoid_of(data).surface.vertices) {
    const Vec3 from_middle = v - body.centre;
    const double height = dot(from_middle, along);
    const double width = 0.27 + 0.73 * std::min(1.0, height * height / 36.0);
    v = body.centre + along * height + (from_middle - along * height) * width;
  }
  return data;
}

/// The same with a scaphoid in two halves, 1.6 mm apart about its middle.
[[nodiscard]] inline cases::CaseData broken_wrist() {
  cases::CaseData data = wrist();
  constexpr double kFaceMm = 0.8;
  const auto it = std::find_if(data.bones.begin(), data.bones.end(), [](const cases::Bone& bone) {
    return bone.bone == BoneId::Scaphoid;
  });
  cases::Bone distal = *it;
  it->part = BonePart::Proximal;
  it->surface = cases::test::half_scaphoid(BonePart::Proximal, kFaceMm);
  distal.part = BonePart::Distal;
  distal.surface = cases::test::half_scaphoid(BonePart::Distal, kFaceMm);
  data.bones.insert(it + 1, std::move(distal));
  return data;
}

[[nodiscard]] inline instruments::InstrumentIndex screw_named(const char* id) {
  return instruments::instrument_of(id).value();
}

[[nodiscard]] inline const instruments::Instrument& short_screw() {
  return instruments::catalogue()[screw_named("acutrak_2_mini_16")];
}

/// Along the axis, its tip distal, the middle of the tip's face so far beyond the pole [mm].
[[nodiscard]] inline PlacedScrew screw_at_distal_pole(double out_mm) {
  const cases::AxisSegment& axis = wrist().scaphoid.central_axis;
  const Vec3 line = normalized_or(axis.distal - axis.proximal, {0, 0, 1});
  return {screw_named("acutrak_2_mini_20"), axis.distal + line * out_mm, -line};
}

[[nodiscard]] inline PlacedScrew short_screw_in_the_middle() {
  const cases::AxisSegment& axis = wrist().scaphoid.central_axis;
  const Vec3 line = normalized_or(axis.distal - axis.proximal, {0, 0, 1});
  return {screw_named("acutrak_2_mini_16"), (axis.proximal + axis.distal) * 0.5 + line * 8.0,
          -line};
}

/// The greatest signed distance over a fine lattice of the screw's envelope.
[[nodiscard]] inline double deepest_by_brute_force(const ScaphoidSurface& surface,
                                                   const PlacedScrew& placed) {
  const auto& screw = placed.instrument();
  const Vec3 a = any_perpendicular(placed.shaft);
  const Vec3 b = cross(placed.shaft, a);
  double deepest = -1e9;
  const auto ring = [&](double z, double radius) {
    for (int j = 0; j < 120; ++j) {
      const double angle = 2 * std::numbers::pi * j / 120;
      const Vec3 p =
          placed.tip + placed.shaft * z + (a * std::cos(angle) + b * std::sin(angle)) * radius;
      deepest = std::max(deepest, surface.signed_distance(p));
    }
  };
  constexpr int kRings = 160;
  for (int i = 0; i <= kRings; ++i) {
    const double share = double{1} * i / kRings;
    ring(share * screw.length_mm,
         0.5 * (screw.tip_diameter_mm + (screw.tail_diameter_mm - screw.tip_diameter_mm) * share));
  }
  for (int i = 0; i <= 20; ++i) {
    ring(0, i / 20.0 * screw.tip_diameter_mm / 2);
    ring(screw.length_mm, i / 20.0 * screw.tail_diameter_mm / 2);
  }
  return deepest;
}

}  // namespace carpus::view_trainer::test
