// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The named views of the C-arm with the way in which the hand is held for each.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "anatomy/hand_pose.hpp"
#include "cases/case_data.hpp"
#include "fluoroscopy/c_arm.hpp"

namespace carpus::view_trainer {

struct StandardView {
  std::string_view id;
  std::string_view label;
  std::string_view name;  ///< for people
  fluoroscopy::ViewAngles angles;
  anatomy::HandPose hand;  ///< from neutral; held back at the wrist's limits
};

/// fluoroscopy::kNamedViews, in their order: the neutral wrist, but for the skyline view, for which
/// it is flexed.
[[nodiscard]] std::span<const StandardView> standard_views();

/// PA with the wrist extended and in ulnar deviation, the next best view of a proximal penetration
/// in [skyline2021]: measured beside the named ones.
[[nodiscard]] const StandardView& pa_extended_view();

/// Index in standard_views(); throws InvalidInput naming those that there are.
[[nodiscard]] std::size_t view_index(std::string_view id);

/// The C-arm and the bones for one view of a case, centred on the scaphoid as it lies then.
struct PosedView {
  fluoroscopy::CArmPose c_arm;
  std::vector<Pose<frame::Patient, frame::Bone>> patient_from_bone;  ///< by CaseData::bones
  Pose<frame::Patient, frame::Bone> patient_from_scaphoid;
};
[[nodiscard]] PosedView pose_view(const cases::CaseData& data,
                                  const StandardView& view,
                                  const fluoroscopy::CArmGeometry& geometry = {});

}  // namespace carpus::view_trainer
