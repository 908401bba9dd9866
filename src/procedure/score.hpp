// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The truth about an operation, from geometry, as every procedure tells it. Items, limits and
// weights are the procedures' own, defined and argued in docs/scoring.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "cases/lesson.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"
#include "procedure/operation_record.hpp"

namespace carpus::procedure {

enum class Grade : std::uint8_t { Good = 0, Acceptable = 1, Fail = 2, NotMeasured = 3 };

/// "good", "acceptable", "fail", "not_measured".
[[nodiscard]] std::string_view name_of(Grade grade) noexcept;

/// One measured thing.
struct ScoreItem {
  std::string id;               ///< stable, snake_case, ends with its unit
  std::string label;            ///< for people
  std::optional<double> value;  ///< empty where there was nothing to measure
  std::string unit;             ///< "deg", "mm", "s", "cGy cm2", "1"
  std::string target;           ///< "at most 5° good, over 15° fail", with units
  Grade grade = Grade::NotMeasured;
  double points = 0.0;
  double points_possible = 0.0;
  std::string reason;  ///< why it matters and what was seen, one or two sentences
  std::string mark;    ///< where the limits come from, as in ScoreRule
};

/// A condition without which the fixation cannot be accepted.
struct MustHave {
  std::string id;
  std::string label;
  bool fulfilled = false;
  bool opens_truth = false;   ///< without it an assessed operation is void
  bool not_measured = false;  ///< there was nothing to judge it by, which fulfils nothing
};

/// A straight line in frame Bone of the target, which is Patient as scanned [mm].
struct PlacedLine {
  Vec3 from;
  Vec3 to;
};

/// Where things lie, to be drawn beside the figures.
/// A piece of the bone that lies beside where it was scanned.
struct PlacedPiece {
  BoneId bone = BoneId::Scaphoid;
  BonePart part = BonePart::Whole;
  Pose<frame::Bone, frame::Bone> pose;  ///< seen from the piece in which the line lies
};

/// In that piece's frame.
struct PlacementPicture {
  PlacedLine central_axis;          ///< proximal to distal
  Vec3 waist;                       ///< on the central axis
  std::optional<PlacedLine> wire;   ///< entry to tip
  std::optional<PlacedLine> screw;  ///< tail to tip
  double screw_tip_diameter_mm = 0.0;
  double screw_tail_diameter_mm = 0.0;
  std::vector<PlacedPiece> pieces;  ///< empty where all lie as scanned
};

/// Where cartilage was scuffed, to be marked on the bones.
struct ScuffedPlace {
  BoneId bone = BoneId::Scaphoid;
  BonePart part = BonePart::Whole;
  std::string instrument;  ///< for people
  CartilageScuff scuff;
};

/// What a case's lesson says of it, for afterwards.
struct CaseAnswer {
  std::string title;
  cases::RightAnswer right_answer = cases::RightAnswer::Fix;
  std::string reason;
};

/// The score of one operation.
struct ScoreReport {
  double overall = 0.0;  ///< 0 to 100, sum of the items' points
  bool is_fixation_acceptable = false;
  bool is_void = false;                   ///< assessed, and there was nothing to assess
  std::vector<std::string> declined_for;  ///< reasons in words; empty: it was not declined
  std::optional<CaseAnswer> answer;       ///< none where the case has no lesson
  std::vector<MustHave> must_haves;
  std::vector<ScoreItem> items;

  double central_axis_length_mm = 0.0;
  double central_cylinder_radius_mm = 0.0;
  double longest_line_mm = 0.0;
  std::optional<double> angle_to_longest_line_deg;
  std::optional<double> true_length_mm;    ///< along the wire between the cortices
  std::optional<double> gauge_reading_mm;  ///< what the trainee measured
  int ideal_screw_index = -1;              ///< among the screws on the tray; -1: there is none
  std::string ideal_screw;                 ///< its name, empty when there is none
  int chosen_screw_index = -1;
  std::string chosen_screw;
  std::string penetration_at;  ///< "proximal", "distal", "side" or empty; with the bone reached
  PlacementPicture placement;
  std::vector<ScuffedPlace> scuffs;  ///< of an arthroscopy, in order of time, the first of them
};

/// An assessed operation may not buy the truth of a case by ending early: where a must-have that
/// opens it is not fulfilled, only that is told.
[[nodiscard]] ScoreReport locked_where_void(ScoreReport report);

}  // namespace carpus::procedure
