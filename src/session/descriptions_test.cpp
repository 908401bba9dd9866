// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/descriptions.hpp"

#include <gtest/gtest.h>

#include "cases/synthetic_case_test_support.hpp"
#include "fluoroscopy/c_arm.hpp"
#include "instruments/instrument.hpp"

namespace carpus::session {
namespace {

/// Towards the source of a view, in Patient, of the C-arm that takes the pictures.
Vec3 towards_source(const cases::CaseData& data, const fluoroscopy::ViewAngles& view) {
  const Direction<frame::Wrist> ulnar{{0, data.side == Side::Left ? 1.0 : -1.0, 0}};
  const fluoroscopy::CArmPose pose =
      fluoroscopy::make_c_arm_pose(view, {{}}, data.wrist_from_patient, ulnar);
  return pose.carm_from_patient.rotation.transposed() * Vec3{0, 0, -1};
}

TEST(CaseDescription, SidesAreThoseOfTheCArm) {
  for (const Side side : {Side::Left, Side::Right}) {
    cases::CaseData data = cases::test::synthetic_case();
    data.side = side;
    const protocol::CaseDescription description = case_description(data);
    const auto& m = description.wrist_from_patient;
    const Vec3 dorsal{-m[8], -m[9], -m[10]};
    const Vec3 radial = Vec3{m[4], m[5], m[6]} * (side == Side::Left ? -1.0 : 1.0);
    EXPECT_LT(distance(dorsal, towards_source(data, {0, 0})), 1e-12);
    EXPECT_LT(distance(radial, towards_source(data, {90, 0})), 1e-12);
    EXPECT_EQ(m[15], 1.0);
  }
}

TEST(CaseDescription, NamesTheBonesOfTheScene) {
  const cases::CaseData data = cases::test::synthetic_case();
  const protocol::CaseDescription description = case_description(data);
  EXPECT_EQ(description.bones.size(), data.bones.size());
  ASSERT_TRUE(protocol::parse_case_description(protocol::serialize(description)).has_value());
}

TEST(InstrumentList, HoldsTheWholeCatalogueWithPartsThatAPageCanDraw) {
  const protocol::InstrumentList list = instrument_list();
  ASSERT_EQ(list.instruments.size(), instruments::catalogue().size());
  const auto read = protocol::parse_instrument_list(protocol::serialize(list));
  ASSERT_TRUE(read.has_value()) << read.error();
  for (const protocol::Instrument& instrument : read->instruments) {
    EXPECT_FALSE(instrument.parts.empty()) << instrument.id;
    EXPECT_GT(instrument.length_mm, 0) << instrument.id;
  }
}

}  // namespace
}  // namespace carpus::session
