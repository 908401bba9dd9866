// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case's hand motion says, in figures: couplings, corrections, overlaps, and how far it is
// from a measured motion.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "anatomy/hand_pose.hpp"
#include "cases/case_data.hpp"

namespace carpus::cli {

/// Rotation of the carpal groups from neutral when the hand is held so.
struct Coupling {
  double flexion_deg = 0;
  double deviation_deg = 0;
  double scaphoid_deg = 0;  ///< turn about the flexion axis; positive flexes
  double lunate_deg = 0;
  double triquetrum_deg = 0;
};

/// Along flexion at neutral deviation and along deviation at neutral flexion, every 20 and 10
/// degrees.
[[nodiscard]] std::vector<Coupling> couplings_of(const cases::CaseData& data);

/// A bone of a measured motion against the table.
struct MeasuredBone {
  BoneId bone = BoneId::Scaphoid;
  std::vector<double> rotation_error_deg;  ///< a position each
  std::vector<double> position_error_mm;   ///< of the bone's middle
  double mean_rotation_error_deg = 0;
  double mean_position_error_mm = 0;
};

struct MeasuredComparison {
  std::vector<std::string> positions;
  std::vector<anatomy::HandPose> hand;  ///< as read off the capitate's rotation
  std::vector<MeasuredBone> bones;
};

/// Compares with a file of measured rigid motions: `poses[]` with `name` and `bones` by name, each
/// `rotation` (rows) and `translation_mm`, in the Wrist frame with the radius at rest, from a first
/// position that is the case's scan. The hand pose of a position is read off its capitate.
/// @throws InvalidInput where the text is no such file or the case is of the other side (a left
///     wrist is expected).
[[nodiscard]] MeasuredComparison compare_with_measured(const cases::CaseData& data,
                                                       std::string_view json_text);

[[nodiscard]] std::string kinematics_table(const cases::CaseData& data,
                                           const std::vector<Coupling>& couplings);
[[nodiscard]] std::string comparison_table(const MeasuredComparison& comparison);

/// docs/json.md, "Kinematics". `comparison` may be null.
[[nodiscard]] std::string kinematics_json(const cases::CaseData& data,
                                          const std::vector<Coupling>& couplings,
                                          const MeasuredComparison* comparison);

}  // namespace carpus::cli
