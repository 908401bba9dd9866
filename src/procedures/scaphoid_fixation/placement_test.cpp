// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Constructed placements against closed form, on exact triangles: a bone that is a prism of many
// sides, whose walls are known.
#include "procedures/scaphoid_fixation/placement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

constexpr double kMm = 0.01;
constexpr double kDeg = 0.01;
constexpr double kRadiusMm = 5.0;
constexpr double kLengthMm = 26.0;
constexpr std::uint32_t kSides = 720;  // its walls lie within 0.05 um of the circle

/// From z = 0, distal, to z = 26, proximal.
MeshIn<frame::Bone> prism() {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * i / kSides;
    const Vec3 rim{kRadiusMm * std::cos(angle), kRadiusMm * std::sin(angle), 0};
    mesh.vertices.push_back(rim);
    mesh.vertices.push_back(rim + Vec3{0, 0, kLengthMm});
  }
  const std::uint32_t bottom = 2 * kSides;
  mesh.vertices.push_back({0, 0, 0});
  mesh.vertices.push_back({0, 0, kLengthMm});
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % kSides);
    mesh.facets.push_back({a, b, b + 1});
    mesh.facets.push_back({a, b + 1, a + 1});
    mesh.facets.push_back({b, a, bottom});
    mesh.facets.push_back({a + 1, b + 1, bottom + 1});
  }
  return MeshIn<frame::Bone>(std::move(mesh));
}

const cases::CaseData& prism_case() {
  static const cases::CaseData data = [] {
    cases::CaseData made = cases::test::synthetic_case();
    for (cases::Bone& bone : made.bones) {
      if (bone.bone == BoneId::Scaphoid) bone.surface = prism();
    }
    made.scaphoid.central_axis = {{0, 0, kLengthMm}, {0, 0, 0}};
    made.scaphoid.longest_line = made.scaphoid.central_axis;
    made.scaphoid.waist = {0, 0, kLengthMm / 2};
    return made;
  }();
  return data;
}

const LyingBone& bone() {
  static const LyingBone made =
      lying_bone({cases::scaphoid_parts(prism_case()).front()->surface}, prism_case().scaphoid);
  return made;
}

/// A screw of 20 mm, 3.6 mm wide at its tail and 3.5 at its tip, from proximal.
procedure::LineFacts screw_at(const Vec3& entry, const Vec3& direction, double depth_mm) {
  procedure::LineFacts lain;
  lain.instrument = *instruments::instrument_of("acutrak_2_mini_20");
  lain.entry_in_bone = entry;
  lain.direction_in_bone = direction;
  lain.depth_mm = depth_mm;
  return lain;
}

struct Placed {
  LinePlacement line;
  ScrewPlacement screw;
};
Placed place(const Vec3& entry, const Vec3& direction, double depth_mm) {
  const auto line = place_line(bone(), prism_case(), Approach::FromProximal, entry, direction);
  EXPECT_TRUE(line.has_value());
  return {*line, place_screw(bone(), prism_case(), *line, Approach::FromProximal,
                             screw_at(entry, direction, depth_mm))};
}

TEST(Placement, AScrewAlongTheAxis) {
  const Placed at = place({0, 0, kLengthMm}, {0, 0, -1}, 22.5);
  EXPECT_NEAR(at.line.angle_deg, 0.0, kDeg);
  EXPECT_NEAR(at.line.length_mm(), kLengthMm, kMm);
  EXPECT_NEAR(at.line.at_waist.distance_mm, 0.0, kMm);
  EXPECT_NEAR(at.line.at_waist.local_width_mm, 2 * kRadiusMm, kMm);
  EXPECT_NEAR(at.screw.tail_cover_mm, 2.5, kMm);
  EXPECT_NEAR(at.screw.tip_cover_mm, 3.5, kMm);
  EXPECT_EQ(at.screw.penetration_mm, 0.0);
  EXPECT_NEAR(at.screw.beside_mm, kRadiusMm - 1.79, kMm) << "4 mm from the tail it is 1.79 wide";
  EXPECT_NEAR(at.screw.in_smaller_part_mm, 20.0, kMm) << "the bone is whole";
}

TEST(Placement, AScrewBesideTheAxis) {
  for (const double aside : {1.0, 2.5, 3.5, 4.0}) {
    const Placed at = place({aside * 0.6, aside * 0.8, kLengthMm}, {0, 0, -1}, 23.0);
    EXPECT_NEAR(at.line.at_waist.distance_mm, aside, kMm);
    EXPECT_NEAR(at.line.at_proximal.distance_mm, aside, kMm);
    // The rim of its tail, the widest place, stands out by what its radius reaches beyond.
    const double reach = aside + 1.8 - kRadiusMm;
    EXPECT_NEAR(at.screw.penetration_mm, std::max(0.0, reach), kMm) << aside;
    EXPECT_NEAR(at.screw.beside_mm, kRadiusMm - aside - 1.79, kMm) << aside;
  }
}

TEST(Placement, AScrewThroughTheFarEnd) {
  for (const double beyond : {0.2, 1.0, 4.0}) {
    const Placed at = place({0, 0, kLengthMm}, {0, 0, -1}, kLengthMm + beyond);
    EXPECT_NEAR(at.screw.tip_cover_mm, -beyond, kMm);
    EXPECT_NEAR(at.screw.penetration_mm, beyond, kMm);
    EXPECT_EQ(at.screw.penetration_at.substr(0, 6), "distal");
  }
}

TEST(Placement, ATailUnderASlopeComesOutByItsRim) {
  const double angle = radians_from_degrees(10.0);
  const Vec3 direction{std::sin(angle), 0, -std::cos(angle)};
  for (const double buried : {0.1, 0.2, 0.6}) {
    const Placed at = place({-1.8, 0, kLengthMm}, direction, 20.0 + buried);
    EXPECT_NEAR(at.screw.tail_cover_mm, buried, kMm) << "its middle is covered";
    const double rim = 1.8 * std::sin(angle) - buried * std::cos(angle);
    EXPECT_NEAR(at.screw.penetration_mm, std::max(0.0, rim), kMm) << buried;
  }
}

TEST(Placement, ASlantedLine) {
  for (const double angle_deg : {2.0, 7.0, 12.0}) {
    const double angle = radians_from_degrees(angle_deg);
    const Vec3 direction{std::sin(angle), 0, -std::cos(angle)};
    // Through the axis' middle, in at the proximal end.
    const Vec3 entry{-std::tan(angle) * kLengthMm / 2, 0, kLengthMm};
    const Placed at = place(entry, direction, 22.0);
    EXPECT_NEAR(at.line.angle_deg, angle_deg, kDeg);
    EXPECT_NEAR(at.line.length_mm(), kLengthMm / std::cos(angle), kMm);
    EXPECT_NEAR(at.line.at_waist.distance_mm, 0.0, kMm);
    EXPECT_NEAR(at.line.at_distal.distance_mm, std::tan(angle) * kLengthMm / 3, kMm);
  }
}

TEST(Placement, SaysWhereTheLineLies) {
  // Patient of the synthetic wrist: proximal is +z, volar -y, ulnar -x.
  EXPECT_EQ(place({0, -2, kLengthMm}, {0, 0, -1}, 22).line.at_waist.towards, "volar");
  EXPECT_EQ(place({2, 0.3, kLengthMm}, {0, 0, -1}, 22).line.at_waist.towards, "radial");
  EXPECT_EQ(place({-1, 1.2, kLengthMm}, {0, 0, -1}, 22).line.at_waist.towards, "dorsal and ulnar");
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
