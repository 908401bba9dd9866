// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/joint_under_block.hpp"

#include <cstddef>

namespace carpus::cases {

std::array<Pose<frame::Patient, frame::Bone>, anatomy::kCarpalGroupCount> poses_under_block(
    const HandMotion& motion,
    const anatomy::HandPose& pose) noexcept {
  auto poses = motion.poses_at(pose);
  anatomy::HandPose at_rest = pose;
  at_rest.traction_n = 0;
  const auto unpulled = motion.poses_at(at_rest);
  for (std::size_t g = 0; g < poses.size(); ++g) {
    const Vec3 opened = poses[g].translation - unpulled[g].translation;
    poses[g].translation += opened * (kUnderBlock - 1.0);
  }
  return poses;
}

Pose<frame::Patient, frame::Bone> pose_under_block(const HandMotion& motion,
                                                   BoneId bone,
                                                   const anatomy::HandPose& pose) noexcept {
  return poses_under_block(motion, pose)[static_cast<std::size_t>(anatomy::group_of(bone))];
}

}  // namespace carpus::cases
