// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/kinematics_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cases/make_hand_motion.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::cli {
namespace {

using anatomy::HandPose;
using ::testing::HasSubstr;

const cases::CaseData& wrist() {
  static const cases::CaseData data = [] {
    cases::CaseData made = cases::test::synthetic_case();
    made.hand_motion = cases::make_hand_motion(made);
    return made;
  }();
  return data;
}

/// What a tracker would write of a wrist that moves as the table says, turned by `error_deg` more
/// about the wrist's x.
nlohmann::json measured_as_in(const std::vector<HandPose>& hands, double lunate_error_deg) {
  const auto& wrist_from_patient = wrist().wrist_from_patient;
  nlohmann::json json;
  for (const HandPose& hand : hands) {
    nlohmann::json bones;
    for (const BoneId bone : kAllBones) {
      const auto motion = wrist().hand_motion.pose_of(bone, hand);
      const Pose<frame::Patient, frame::Patient> in_patient{motion.rotation, motion.translation};
      auto in_wrist = wrist_from_patient * in_patient * wrist_from_patient.inverse();
      if (bone == BoneId::Lunate) {
        in_wrist.rotation =
            rotation_about({1, 0, 0}, radians_from_degrees(lunate_error_deg)) * in_wrist.rotation;
      }
      nlohmann::json rows;
      for (const Vec3& row : in_wrist.rotation.rows) rows.push_back({row.x, row.y, row.z});
      const Vec3& t = in_wrist.translation;
      bones[std::string(name_of(bone))] = {{"rotation", rows}, {"translation_mm", {t.x, t.y, t.z}}};
    }
    json["poses"].push_back(
        {{"name", "P" + std::to_string(json["poses"].size())}, {"bones", bones}});
  }
  return json;
}

TEST(KinematicsReport, FindsNoErrorInAMotionThatIsTheTables) {
  const HandPose scan = wrist().hand_motion.scan;
  HandPose other = scan;  // a node of the table, where the hand is exactly as asked
  other.flexion_rad = wrist().hand_motion.flexion_rad[6];
  const auto result = compare_with_measured(wrist(), measured_as_in({scan, other}, 0).dump());
  ASSERT_EQ(result.positions.size(), 2U);
  EXPECT_NEAR(result.hand[1].flexion_rad, other.flexion_rad, 1e-4);
  ASSERT_EQ(result.bones.size(), 4U);  // scaphoid, lunate, capitate, trapezium
  for (const MeasuredBone& bone : result.bones) {
    EXPECT_LT(bone.mean_rotation_error_deg, 0.05) << name_of(bone.bone);
    EXPECT_LT(bone.mean_position_error_mm, 0.05) << name_of(bone.bone);
  }
}

TEST(KinematicsReport, FindsTheErrorThatWasPutIn) {
  const auto result =
      compare_with_measured(wrist(), measured_as_in({wrist().hand_motion.scan}, 7).dump());
  for (const MeasuredBone& bone : result.bones) {
    EXPECT_NEAR(bone.mean_rotation_error_deg, bone.bone == BoneId::Lunate ? 7 : 0, 0.01);
  }
}

TEST(KinematicsReport, RefusesFilesThatAreNoMotionsAndRightWrists) {
  EXPECT_THROW((void)compare_with_measured(wrist(), "{}"), InvalidInput);
  EXPECT_THROW((void)compare_with_measured(wrist(), "no json"), InvalidInput);
  cases::CaseData right = wrist();
  right.side = Side::Right;
  EXPECT_THROW((void)compare_with_measured(right, measured_as_in({{}}, 0).dump()), InvalidInput);
}

TEST(KinematicsReport, SaysTheSameInTablesAndJson) {
  const auto couplings = couplings_of(wrist());
  const std::string table = kinematics_table(wrist(), couplings);
  EXPECT_THAT(table, HasSubstr("scaphoid"));
  EXPECT_THAT(table, HasSubstr("greatest overlap"));
  const auto json = nlohmann::json::parse(kinematics_json(wrist(), couplings, nullptr));
  EXPECT_EQ(json.at("couplings").size(), couplings.size());
  EXPECT_EQ(json.at("corrections").size(), 4U);
  EXPECT_EQ(json.at("overlap_at_nodes_mm"), wrist().hand_motion.report.overlap_at_nodes_mm);
  EXPECT_TRUE(json.at("measured").is_null());
  EXPECT_NEAR(json.at("limits").at("flexion_deg")[1].get<double>(), 80, 1e-3);
}

}  // namespace
}  // namespace carpus::cli
