// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/posture.hpp"

#include <gtest/gtest.h>

#include <array>

#include "cases/scaphoid_landmarks.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"

namespace carpus::cases {
namespace {

const CaseData& wrist() {
  static const CaseData data = test::synthetic_case();
  return data;
}

std::array<std::size_t, 32> voxels_by_label(const Grid<std::uint8_t>& labels) {
  std::array<std::size_t, 32> counts{};
  for (const std::uint8_t label : labels.values()) ++counts[label];
  return counts;
}

TEST(ScaphoidLandmarks, AreThoseOfTheEllipsoidByConstruction) {
  const ScaphoidLandmarks found = find_scaphoid_landmarks(wrist());
  const ScaphoidLandmarks& known = wrist().scaphoid;
  EXPECT_LT(distance(found.central_axis.proximal, known.central_axis.proximal), 0.25);
  EXPECT_LT(distance(found.central_axis.distal, known.central_axis.distal), 0.25);
  EXPECT_NEAR(found.central_radius_mm, known.central_radius_mm, 0.05);
}

TEST(Posture, IsTheSmallestFlexionThatLeavesRoom) {
  const Posture chosen = choose_operative_posture(wrist());
  EXPECT_GE(approach_clearance_mm(wrist(), chosen), kDriverClearanceMm);
  const double step = radians_from_degrees(kPostureStepDeg);
  ASSERT_GT(chosen.flexion_from_scan_rad, step / 2) << "the test wrist is blocked when neutral";
  const Posture less = posture_of_flexion(wrist(), chosen.flexion_from_scan_rad - step);
  EXPECT_LT(approach_clearance_mm(wrist(), less), kDriverClearanceMm);
}

TEST(Posture, FlexionTakesTheForearmVolarwardsOnEitherSide) {
  for (const Side side : {Side::Left, Side::Right}) {
    CaseData data = wrist();
    data.side = side;
    if (side == Side::Right) {  // mirrored anatomy: +y of the wrist is now radial, Patient -x
      for (Bone& bone : data.bones) {
        for (Vec3& v : bone.surface.vertices) v.x = -v.x;
      }
    }
    const Posture posture = posture_of_flexion(data, radians_from_degrees(40));
    const Vec3 radius = centroid_of(find_bone(data, BoneId::Radius)->surface);
    const Vec3 moved = (posture.patient_from_forearm * Point<frame::Bone>{radius}).v;
    EXPECT_LT(moved.y, radius.y - 5) << "a flexed wrist closes on its volar side, -y";
  }
}

TEST(Posture, MovesBonesRigidlyAndNeitherBlursNorDoublesThem) {
  const Posture posture = posture_of_flexion(wrist(), radians_from_degrees(35));
  const CaseData bent = apply_posture(wrist(), posture);
  const auto before = voxels_by_label(wrist().labels);
  const auto after = voxels_by_label(bent.labels);
  for (const Bone& bone : bent.bones) {
    const double change =
        static_cast<double>(after[bone.label]) / static_cast<double>(before[bone.label]);
    EXPECT_NEAR(change, 1.0, 0.03) << name_of(bone.bone);
    const bool moved = belongs_to_forearm(bone.bone);
    EXPECT_EQ(bone.patient_from_bone == posture.patient_from_forearm, moved);
  }
  std::size_t misplaced = 0;
  std::size_t bone_elsewhere = 0;
  const GridGeometry& g = bent.ct.geometry();
  for (std::size_t i = 0; i < bent.labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    if (bent.labels[i] == kBackgroundLabel) {
      if (bent.ct[i] >= 500) ++bone_elsewhere;
      continue;
    }
    const Bone* bone = find_bone(bent, static_cast<BoneId>(bent.labels[i]));
    const Vec3 local = (bone->patient_from_bone.inverse() * Point<frame::Patient>{p}).v;
    const VoxelIndex source{static_cast<int>(local.x + 39.5 + 0.5),
                            static_cast<int>(local.y + 27.5 + 0.5),
                            static_cast<int>(local.z + 44.5 + 0.5)};
    if (!wrist().labels.geometry().contains(source) || wrist().labels[source] != bent.labels[i]) {
      ++misplaced;
    }
  }
  EXPECT_LT(misplaced, 20U);
  EXPECT_LT(bone_elsewhere, 200U) << "cortex blurred into the voxels beside it, at most";
}

TEST(Posture, SkinFollowsSmoothly) {
  const Posture posture = posture_of_flexion(wrist(), radians_from_degrees(35));
  const CaseData bent = apply_posture(wrist(), posture);
  ASSERT_EQ(bent.skin.vertices.size(), wrist().skin.vertices.size());
  double longest = 0;
  for (const auto& [a, b, c] : bent.skin.facets) {
    const double before = distance(wrist().skin.vertices[a], wrist().skin.vertices[b]);
    longest = std::max(longest, distance(bent.skin.vertices[a], bent.skin.vertices[b]) / before);
  }
  EXPECT_LT(longest, 4.0) << "no facet is torn";
  double most = 0;
  for (std::size_t i = 0; i < bent.skin.vertices.size(); ++i) {
    most = std::max(most, distance(bent.skin.vertices[i], wrist().skin.vertices[i]));
  }
  EXPECT_GT(most, 20.0) << "the forearm's skin goes with it";
}

TEST(Posture, OfTheScanChangesNothing) {
  const CaseData same = apply_posture(wrist(), Posture{});
  EXPECT_EQ(same.ct.geometry(), wrist().ct.geometry());
  EXPECT_EQ(same.skin.vertices, wrist().skin.vertices);
}

}  // namespace
}  // namespace carpus::cases
