// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/joint_under_block.hpp"

#include <gtest/gtest.h>

#include "cases/make_hand_motion.hpp"
#include "cases/synthetic_case_test_support.hpp"

namespace carpus::cases {
namespace {

const HandMotion& motion() {
  static const HandMotion made = make_hand_motion(test::synthetic_case());
  return made;
}

TEST(JointUnderBlock, TheSamePullOpensItMoreAndAlongTheSameWay) {
  anatomy::HandPose pose = motion().scan;
  const Vec3 rest = motion().pose_of(BoneId::Lunate, pose).translation;
  pose.traction_n = 69;
  const Vec3 awake = motion().pose_of(BoneId::Lunate, pose).translation - rest;
  const Vec3 opened = pose_under_block(motion(), BoneId::Lunate, pose).translation - rest;
  EXPECT_NEAR(length(awake), 0.7, 0.05) << "[S66] 1.0 mm at 98 N";
  EXPECT_LT(length(opened - awake * kUnderBlock), 1e-9);
}

TEST(JointUnderBlock, WithoutPullNothingIsOpened) {
  const auto awake = motion().poses_at(motion().scan);
  const auto opened = poses_under_block(motion(), motion().scan);
  for (std::size_t g = 0; g < awake.size(); ++g) {
    EXPECT_EQ(opened[g].translation, awake[g].translation);
  }
}

}  // namespace
}  // namespace carpus::cases
