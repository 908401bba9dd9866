// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is measured: a case, its bodies, poses and views.
#pragma once

#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "core/units.hpp"
#include "fluoroscopy/c_arm.hpp"
#include "fluoroscopy/tissue_bending.hpp"

namespace carpus::bench {

using BodyPoses = std::vector<Pose<frame::Patient, frame::Bone>>;

/// Forearm and hand are the segments.
[[nodiscard]] inline std::vector<fluoroscopy::BodyLabel> bodies_of(const cases::CaseData& data) {
  std::vector<fluoroscopy::BodyLabel> bodies;
  for (const cases::Bone& bone : data.bones) {
    bodies.push_back({bone.label, belongs_to_forearm(bone.bone) ? 1 : 0});
  }
  return bodies;
}

/// The hand flexed by so much from how it was scanned, every carpal bone where it then goes; the
/// forearm keeps still.
[[nodiscard]] inline BodyPoses flexed(const cases::CaseData& data, double flexion_deg) {
  anatomy::HandPose pose = data.hand_motion.scan;
  pose.flexion_rad += radians_from_degrees(flexion_deg);
  BodyPoses poses;
  for (const cases::Bone& bone : data.bones) {
    poses.push_back(data.hand_motion.pose_of(bone.bone, pose));
  }
  return poses;
}

/// Centred between the scaphoid's ends as scanned.
[[nodiscard]] inline fluoroscopy::CArmPose c_arm(const cases::CaseData& data,
                                                 const fluoroscopy::ViewAngles& view,
                                                 int pixels) {
  fluoroscopy::CArmGeometry geometry;
  geometry.pixels = pixels;
  const auto& axis = data.scaphoid.central_axis;
  return fluoroscopy::make_c_arm_pose(view, {(axis.proximal + axis.distal) * 0.5},
                                      data.wrist_from_patient,
                                      {{0, data.side == Side::Left ? 1.0 : -1.0, 0}}, geometry);
}

}  // namespace carpus::bench
