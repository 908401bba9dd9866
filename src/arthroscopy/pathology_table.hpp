// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What may be wrong in an examined wrist, as data (data/pathology.json).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/joint_lesions.hpp"

namespace carpus::arthroscopy {

/// What else shows where a grade is.
struct PatchBeside {
  std::string near;        ///< id of a tour's point
  std::string on;          ///< bone that it goes with
  double radially_mm = 0;  ///< from that point, of the generic wrist
  cases::LesionLook shows = cases::LesionLook::Bare;
  double radius_mm = 0;
};

/// A grade of another finding, or a worse one where that scale is ordered.
struct WithGrade {
  std::size_t finding = 0;
  std::uint8_t grade = 0;
};

struct Grade {
  std::string id;     ///< "II"
  std::string label;  ///< for people
  std::optional<cases::LesionLook> shows;
  double length_mm = 0;
  double radius_mm = 0;
  double distal_radius_mm = 0;  ///< of a ligament's line in the midcarpal joint; 0: closed there
  double gap_mm = 0;
  double step_mm = 0;
  double passes_mm = 0;
  bool is_drawn = true;  ///< also for recordings that name no grades, from before it was there
  std::optional<PatchBeside> beside;
  std::optional<WithGrade> with;
  std::string
      more_than;  ///< id of a grade of the same scale, which this one is where `with` is there
};

struct Scale {
  std::string id;
  std::string name;
  bool is_ordered = false;    ///< a grade beside the true one is nearly right
  std::vector<Grade> grades;  ///< the first is that of what is well

  /// How many of those that are wrong are drawn for recordings that name none: they stand first.
  [[nodiscard]] std::size_t drawn() const;
};

/// Of a ligament between two bones: where its line shows, and which bones part.
struct TornLine {
  std::string in_radiocarpal;  ///< id of the tour's point
  std::string in_midcarpal;
  std::string moves;                   ///< bone
  std::vector<std::string> away_from;  ///< bones
};

struct Finding {
  std::string id;
  std::string label;
  std::size_t scale = 0;  ///< in `scales`
  double chance = 0;      ///< in a wrist that is not healthy
  std::optional<TornLine> line;
  std::string at;                  ///< id of the tour's point that a patch lies near
  std::vector<std::string> among;  ///< of points, one of which it lies by
};

struct PathologyTable {
  double full_traction_n = 0;
  double healthy_share = 0;
  std::vector<Finding> findings;
  std::vector<Scale> scales;

  [[nodiscard]] const Scale& scale_of(std::size_t finding) const {
    return scales[findings[finding].scale];
  }
  /// @throws InvalidInput naming the entry where the text is no such table.
  /// Of any file that asks: findings and scales alone.
  [[nodiscard]] static PathologyTable parse_questions(std::string_view json_text);
  /// @throws InvalidInput likewise.
  [[nodiscard]] static PathologyTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const PathologyTable& generic();
};

}  // namespace carpus::arthroscopy
