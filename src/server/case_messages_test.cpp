// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/case_messages.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cases/posture.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"
#include "fluoroscopy/c_arm.hpp"

namespace carpus::server {
namespace {

/// Towards the source of a view, in Patient, of the C-arm that takes the pictures.
Vec3 towards_source(const cases::CaseData& posed_case, const fluoroscopy::ViewAngles& view) {
  const Direction<frame::Wrist> ulnar{{0, posed_case.side == Side::Left ? 1.0 : -1.0, 0}};
  const fluoroscopy::CArmPose pose =
      fluoroscopy::make_c_arm_pose(view, {{}}, cases::held_wrist_from_patient(posed_case), ulnar);
  return pose.carm_from_patient.rotation.transposed() * Vec3{0, 0, -1};
}

TEST(CaseDescription, SidesAreThoseOfTheCArmOverAFlexedWrist) {
  for (const Side side : {Side::Left, Side::Right}) {
    cases::CaseData data = cases::test::synthetic_case();
    data.side = side;
    const double flexion = radians_from_degrees(40);
    data.operative_posture = cases::posture_of_flexion(data, flexion);
    const protocol::CaseDescription description = case_description(data);
    const std::array<double, 16>& m = description.held_wrist_from_patient;
    EXPECT_NEAR(description.flexion_deg, 40, 1e-9);

    const Vec3 dorsal{-m[8], -m[9], -m[10]};
    const Vec3 radial = Vec3{m[4], m[5], m[6]} * (side == Side::Left ? -1.0 : 1.0);
    EXPECT_LT(distance(dorsal, towards_source(data, {0, 0})), 1e-12);
    EXPECT_LT(distance(radial, towards_source(data, {90, 0})), 1e-12);
    const Vec3 scanned = data.wrist_from_patient.rotation.transposed() * Vec3{0, 0, -1};
    EXPECT_NEAR(dot(dorsal, scanned), std::cos(flexion), 1e-12) << "the scan's dorsal is another";
    EXPECT_NEAR(dot(radial, data.wrist_from_patient.rotation.rows[1]), side == Side::Left ? -1 : 1,
                1e-12);
  }
}

TEST(CaseDescription, WristAsHeldFollowsTheForearmsBones) {
  cases::CaseData data = cases::test::synthetic_case();
  data.operative_posture = cases::posture_of_flexion(data, radians_from_degrees(25));
  const Point<frame::Bone> in_radius{{-2, 12, 43}};
  const Point<frame::Wrist> held = cases::held_wrist_from_patient(data) *
                                   (data.operative_posture.patient_from_forearm * in_radius);
  const Point<frame::Wrist> scanned = data.wrist_from_patient * Point<frame::Patient>{in_radius.v};
  EXPECT_LT(distance(held.v, scanned.v), 1e-9);
}

}  // namespace
}  // namespace carpus::server
