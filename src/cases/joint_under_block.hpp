// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the bones are while one works in the joint: without the muscles' tone and with fluid in it,
// the same pull opens it more than it opened in the awake volunteers whose wrists the hand's motion
// is fitted to [S66: 1.0 and 2.0 mm at 98 N, standard deviations 1.0 and 1.7 mm].
#pragma once

#include <array>

#include "cases/hand_motion.hpp"

namespace carpus::cases {

/// Times the awake opening [E]: a standard deviation more at the radiocarpal joint. That a block
/// lets it open more is known [K], by how much was not found.
inline constexpr double kUnderBlock = 2.0;

/// As HandMotion::poses_at, opened so. Real-time as that.
[[nodiscard]] std::array<Pose<frame::Patient, frame::Bone>, anatomy::kCarpalGroupCount>
poses_under_block(const HandMotion& motion, const anatomy::HandPose& pose) noexcept;

/// The same for one bone.
[[nodiscard]] Pose<frame::Patient, frame::Bone>
pose_under_block(const HandMotion& motion, BoneId bone, const anatomy::HandPose& pose) noexcept;

}  // namespace carpus::cases
