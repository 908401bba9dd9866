// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is measured: a case, its bodies, poses and views.
#pragma once

#include <string>
#include <vector>

#include "cases/case_data.hpp"
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

[[nodiscard]] inline BodyPoses poses_of(
    const cases::CaseData& data,
    const Pose<frame::Patient, frame::Bone>& patient_from_forearm) {
  BodyPoses poses;
  for (const cases::Bone& bone : data.bones) {
    poses.push_back(belongs_to_forearm(bone.bone) ? patient_from_forearm
                                                  : Pose<frame::Patient, frame::Bone>{});
  }
  return poses;
}

/// Centred between the scaphoid's ends, as for the operation.
[[nodiscard]] inline fluoroscopy::CArmPose c_arm(
    const cases::CaseData& data,
    const fluoroscopy::ViewAngles& view,
    const Pose<frame::Patient, frame::Bone>& patient_from_forearm,
    int pixels) {
  fluoroscopy::CArmGeometry geometry;
  geometry.pixels = pixels;
  const auto& axis = data.scaphoid.central_axis;
  const Pose<frame::Patient, frame::Patient> turned{patient_from_forearm.rotation,
                                                    patient_from_forearm.translation};
  return fluoroscopy::make_c_arm_pose(view, {(axis.proximal + axis.distal) * 0.5},
                                      data.wrist_from_patient * turned.inverse(),
                                      {{0, data.side == Side::Left ? 1.0 : -1.0, 0}}, geometry);
}

}  // namespace carpus::bench
