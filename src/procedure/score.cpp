// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Limits and weights are those of docs/scoring.md, in its order; figures without a published source
// are engineering proposals and marked so there.
#include "procedure/score.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

#include "anatomy/bone_words.hpp"
#include "procedure/detail/placement.hpp"

namespace carpus::procedure {
namespace {

using detail::LinePlacement;
using detail::Offset;
using detail::ScrewPlacement;

std::string text_of(double value, const char* format = "%.1f") {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string in_words(View view) {
  static constexpr std::array<std::string_view, kViewCount> kWords{
      "PA", "lateral", "45° pronated oblique", "proximal pole"};
  return std::string(kWords.at(static_cast<std::size_t>(view)));
}

/// What is known before any item is graded.
struct Facts {
  const cases::CaseData& data;
  const OperationRecord& record;
  std::optional<LinePlacement> line;
  std::optional<ScrewPlacement> screw;
  bool is_acceptable = false;
};

/// Full points up to `good`, falling linearly to none at `fail`.
double falling_points(double value, double good, double fail, double possible) {
  if (!(value > good)) return possible;
  if (!(value < fail)) return 0.0;
  return possible * (fail - value) / (fail - good);
}

/// Grades a value of which less is better.
void grade_falling(ScoreItem& item, double value, double good, double fail) {
  item.value = value;
  item.points = falling_points(value, good, fail, item.points_possible);
  item.grade = value <= good ? Grade::Good : (value > fail ? Grade::Fail : Grade::Acceptable);
}

ScoreItem make_item(const char* id, const char* label, const char* unit, double possible) {
  ScoreItem item;
  item.id = id;
  item.label = label;
  item.unit = unit;
  item.points_possible = possible;
  return item;
}

constexpr const char* kNoWire = "No wire lies in the scaphoid: there is nothing to measure.";
constexpr const char* kNoScrew = "No screw lies in the scaphoid: there is nothing to measure.";

ScoreItem score_angle(const Facts& facts) {
  ScoreItem item = make_item("angle_to_central_axis_deg", "Angle to the central axis", "deg", 15);
  item.target = "at most 5° good, over 15° fail";
  item.reason = kNoWire;
  if (!facts.line) return item;
  grade_falling(item, facts.line->angle_deg, 5.0, 15.0);
  item.reason =
      "A screw along the central axis holds the fracture stiffest and has the longest way in bone "
      "before it can come out.";
  return item;
}

ScoreItem score_offset(const Facts& facts,
                       const char* id,
                       const char* label,
                       double possible,
                       const Offset LinePlacement::*which) {
  ScoreItem item = make_item(id, label, "mm", possible);
  item.target = "central third of the bone";
  item.reason = kNoWire;
  if (!facts.line) return item;
  const Offset& offset = (*facts.line).*which;
  const double good = offset.local_width_mm / 6.0;
  const double fail = offset.local_width_mm / 3.0;
  grade_falling(item, offset.distance_mm, good, fail);
  item.target =
      "at most " + text_of(good) + " mm good (central third), over " + text_of(fail) + " mm fail";
  item.reason = "The bone is " + text_of(offset.local_width_mm) +
                " mm wide here; within a sixth of that beside the axis is its central third, where "
                "screws lead to union sooner and hold twice as stiff.";
  return item;
}

ScoreItem score_cover(const Facts& facts,
                      const char* id,
                      const char* label,
                      double ScrewPlacement::*which) {
  constexpr double kTargetMm = 2.0;
  constexpr double kGoodWithinMm = 0.75;
  constexpr double kFailMm = 0.5;
  constexpr double kTooDeepMm = 6.0;
  ScoreItem item = make_item(id, label, "mm", 8);
  item.target = "2 ± 0.75 mm good, under 0.5 mm fail";
  item.reason = kNoScrew;
  if (!facts.screw) return item;
  const double cover = (*facts.screw).*which;
  item.value = cover;
  const double off = std::abs(cover - kTargetMm);
  if (off <= kGoodWithinMm) {
    item.grade = Grade::Good;
    item.points = item.points_possible;
  } else if (cover < kFailMm) {
    item.grade = Grade::Fail;
  } else {
    item.grade = Grade::Acceptable;
    const double worst = cover < kTargetMm ? kTargetMm - kFailMm : kTooDeepMm - kTargetMm;
    item.points = falling_points(off, kGoodWithinMm, worst, item.points_possible);
  }
  item.reason = cover < kFailMm
                    ? "The end of the screw is not covered: it wears the joint's cartilage."
                    : "The outer 2 mm of bone are the densest: the thread should end in them and "
                      "not come through.";
  return item;
}

ScoreItem score_penetration(const Facts& facts) {
  ScoreItem item = make_item("penetration_mm", "Screw outside the bone", "mm", 12);
  item.target = "0 mm good, over 0.5 mm fail";
  item.reason = kNoScrew;
  if (!facts.screw) return item;
  const double depth = facts.screw->penetration_mm;
  item.value = depth;
  item.grade = depth <= 0.0 ? Grade::Good : (depth > 0.5 ? Grade::Fail : Grade::Acceptable);
  item.points = falling_points(depth, 0.0, 0.5, item.points_possible);
  item.reason = depth > 0 ? "The screw stands out of the bone: " + facts.screw->penetration_at + "."
                          : "No part of the screw stands out of the scaphoid.";
  return item;
}

ScoreItem score_length(const Facts& facts, const ScoreReport& report) {
  ScoreItem item = make_item("screw_length_minus_ideal_mm", "Screw length against ideal", "mm", 10);
  item.target = "0 mm good; longer than ideal, or more than 4 mm shorter, fail";
  item.reason = kNoScrew;
  const auto catalogue = screw_catalogue();
  if (!facts.screw) return item;
  if (!report.true_length_mm || report.ideal_screw_index < 0) {
    item.grade = Grade::Fail;
    item.reason = "On this line the bone is too short for any screw on the tray.";
    return item;
  }
  const double chosen = catalogue[static_cast<std::size_t>(facts.record.screw_index)].length_mm;
  const double ideal = catalogue[static_cast<std::size_t>(report.ideal_screw_index)].length_mm;
  const double difference = chosen - ideal;
  item.value = difference;
  const bool is_good = difference == 0;
  const bool is_fail = difference > 0 || difference < -4.0;
  item.grade = is_good ? Grade::Good : (is_fail ? Grade::Fail : Grade::Acceptable);
  item.points = is_fail ? 0.0 : falling_points(-difference, 0.0, 4.5, item.points_possible);
  item.reason = "The wire's line is " + text_of(*report.true_length_mm) +
                " mm long between the cortices; 4 mm less, for 2 mm of bone at each end, allows " +
                text_of(ideal) + " mm. A screw too long is the most common error.";
  return item;
}

ScoreItem score_passes(const Facts& facts) {
  ScoreItem item = make_item("wire_passes", "Wire passes", "1", 5);
  item.target = "1 pass good, over 3 fail";
  if (facts.record.passes == 0) {
    item.reason = kNoWire;
    return item;
  }
  grade_falling(item, facts.record.passes, 1.0, 3.0);
  item.reason = "Each pass takes bone in which the screw is to hold, and cartilage at the entry.";
  return item;
}

/// Bit i: View i was taken while the wire was in place or later.
unsigned views_after_driving(const OperationRecord& record) {
  unsigned seen = 0;
  for (const Shot& shot : record.shots) {
    if (!shot.wire_in_bone && !shot.screw_in) continue;
    for (int i = 0; i < kViewCount; ++i) {
      if (shows(static_cast<View>(i), shot.rotation_deg, shot.tilt_deg)) seen |= 1U << i;
    }
  }
  return seen;
}

ScoreItem score_views(const Facts& facts) {
  ScoreItem item = make_item("required_views_seen", "Required views before the end", "1", 5);
  item.target = "all 4 good (PA, lateral, 45° pronated oblique, proximal pole), under 3 fail";
  const unsigned seen = views_after_driving(facts.record);
  const int count = std::popcount(seen);
  item.value = count;
  item.grade = count == kViewCount ? Grade::Good : (count < 3 ? Grade::Fail : Grade::Acceptable);
  item.points = item.points_possible * count / kViewCount;
  item.reason = "PA and lateral alone miss half of the distal penetrations.";
  for (int i = 0; i < kViewCount; ++i) {
    if ((seen >> i & 1U) == 0) {
      item.reason += " Not taken after driving: ";
      item.reason += in_words(static_cast<View>(i));
      item.reason += ".";
    }
  }
  return item;
}

ScoreItem score_wrong_bones(const Facts& facts) {
  ScoreItem item = make_item("wrong_bones_entered", "Other bones entered", "1", 4);
  item.target = "none good, any fail";
  if (facts.record.passes == 0 && facts.record.wrong_bones == 0) {
    item.reason = kNoWire;
    return item;
  }
  item.value = std::popcount(facts.record.wrong_bones);
  item.grade = facts.record.wrong_bones == 0 ? Grade::Good : Grade::Fail;
  item.points = facts.record.wrong_bones == 0 ? item.points_possible : 0.0;
  item.reason = "The wire should enter no bone but the scaphoid.";
  for (const BoneId bone : kAllBones) {
    if ((facts.record.wrong_bones >> static_cast<unsigned>(bone) & 1U) == 0) continue;
    item.reason += " Entered: the ";
    item.reason += words_of(bone);
    item.reason += ".";
  }
  return item;
}

/// Thrift counts only when the result is acceptable: novices take the fewest pictures.
void grade_thrift(ScoreItem& item, const Facts& facts, double value, double good, double fail) {
  grade_falling(item, value, good, fail);
  if (facts.is_acceptable) return;
  item.points = 0.0;
  item.reason += " Earns points only with an acceptable fixation.";
}

ScoreItem score_shots(const Facts& facts) {
  ScoreItem item = make_item("shots", "Fluoroscopy shots", "1", 1);
  item.target = "at most 40 good, over 90 fail";
  item.reason = "Counts only what is beyond need; fewer shots never earn more.";
  for (int i = 0; i < kViewCount; ++i) {
    const auto view = static_cast<View>(i);
    const auto count = std::count_if(
        facts.record.shots.begin(), facts.record.shots.end(),
        [&](const Shot& shot) { return shows(view, shot.rotation_deg, shot.tilt_deg); });
    item.reason += i == 0 ? " Taken: " : ", ";
    item.reason += in_words(view);
    item.reason += " " + std::to_string(count);
  }
  item.reason += ".";
  grade_thrift(item, facts, static_cast<double>(facts.record.shots.size()), 40.0, 90.0);
  return item;
}

ScoreItem score_dose(const Facts& facts) {
  ScoreItem item = make_item("dose_cgy_cm2", "Dose-area product", "cGy cm2", 1);
  item.target = "at most 20 cGy cm² good, over 45.6 cGy cm² fail";
  item.reason = "A whole conventional operation was measured at 45.6 cGy cm²; a shot counts 0.5.";
  grade_thrift(item, facts, kDosePerShotCgyCm2 * static_cast<double>(facts.record.shots.size()),
               20.0, 45.6);
  return item;
}

ScoreItem score_time(const Facts& facts) {
  ScoreItem item = make_item("time_s", "Time", "s", 2);
  item.target = "at most 10 min good, over 30 min fail";
  item.reason =
      "Time separates experts from novices in most studies, but only beside a good result.";
  grade_thrift(item, facts, static_cast<double>(facts.record.ticks) * kTickSeconds, 600.0, 1800.0);
  return item;
}

ScoreItem score_undos(const Facts& facts) {
  ScoreItem item = make_item("undos", "Steps taken back", "1", 1);
  item.target = "none good, over 2 fail";
  if (facts.record.passes == 0) {
    item.reason = kNoWire;
    return item;
  }
  item.reason = "Patients have no undo.";
  grade_falling(item, facts.record.undos, 0.0, 2.0);
  return item;
}

std::vector<MustHave> check_must_haves(const Facts& facts) {
  const auto& line = facts.line;
  const auto& screw = facts.screw;
  const double buried = screw ? screw->proximal_cover_mm : -1.0;
  const double tip = screw ? screw->distal_cover_mm : -1.0;
  return {
      {"screw_placed", "A screw lies in the scaphoid", screw.has_value()},
      {"angle", "Within 15° of the central axis", line && line->angle_deg <= 15.0},
      {"waist", "Through the middle two thirds of the waist",
       line && line->at_waist.distance_mm <= line->at_waist.local_width_mm / 3.0},
      {"cover", "At least 0.5 mm of bone over both ends", buried >= 0.5 && tip >= 0.5},
      {"penetration", "No part more than 0.5 mm outside the bone",
       screw && screw->penetration_mm <= 0.5},
  };
}

void fill_references(ScoreReport& report, const Facts& facts) {
  const cases::ScaphoidLandmarks& marks = facts.data.scaphoid;
  report.central_axis_length_mm = distance(marks.central_axis.proximal, marks.central_axis.distal);
  report.central_cylinder_radius_mm = marks.central_radius_mm;
  report.longest_line_mm = distance(marks.longest_line.proximal, marks.longest_line.distal);
  if (facts.record.measured_mm >= 0) report.gauge_reading_mm = facts.record.measured_mm;
  const auto catalogue = screw_catalogue();
  if (facts.line) {
    report.angle_to_longest_line_deg = facts.line->angle_to_longest_deg;
    report.true_length_mm = facts.line->chord.leave_mm - facts.line->chord.enter_mm;
    report.ideal_screw_index = ideal_screw_index(catalogue, *report.true_length_mm);
  }
  if (report.ideal_screw_index >= 0) {
    report.ideal_screw = catalogue[static_cast<std::size_t>(report.ideal_screw_index)].name;
  }
  if (facts.screw) {
    report.chosen_screw_index = facts.record.screw_index;
    report.chosen_screw = catalogue[static_cast<std::size_t>(facts.record.screw_index)].name;
    report.penetration_at = facts.screw->penetration_at;
  }
}

PlacementPicture picture_of(const Facts& facts) {
  const cases::ScaphoidLandmarks& marks = facts.data.scaphoid;
  const OperationRecord& record = facts.record;
  PlacementPicture picture;
  picture.central_axis = {marks.central_axis.proximal, marks.central_axis.distal};
  picture.waist = marks.waist;
  if (!record.wire_in_scaphoid) return picture;
  const auto at = [&](double depth_mm) {
    return record.entry_in_patient + record.direction_in_patient * depth_mm;
  };
  picture.wire = PlacedLine{record.entry_in_patient, at(record.wire_depth_mm)};
  if (!facts.screw) return picture;
  const Screw& screw = screw_catalogue()[static_cast<std::size_t>(record.screw_index)];
  picture.screw =
      PlacedLine{at(record.screw_advance_mm - screw.length_mm), at(record.screw_advance_mm)};
  picture.screw_tip_diameter_mm = screw.tip_diameter_mm;
  picture.screw_tail_diameter_mm = screw.tail_diameter_mm;
  return picture;
}

}  // namespace

std::string_view name_of(Grade grade) noexcept {
  static constexpr std::array<std::string_view, 4> kNames{"good", "acceptable", "fail",
                                                          "not_measured"};
  const auto index = static_cast<std::size_t>(grade);
  return index < kNames.size() ? kNames[index] : std::string_view{"unknown"};
}

ScoreReport score_operation(const cases::CaseData& data, const OperationRecord& record) {
  std::vector<const TriangleMesh*> fragments;
  for (const cases::Bone* part : cases::scaphoid_parts(data)) fragments.push_back(&part->surface);
  const BoneSolid scaphoid(fragments);
  Facts facts{data, record, std::nullopt, std::nullopt, false};
  if (record.wire_in_scaphoid) {
    facts.line = detail::place_line(scaphoid, data.scaphoid, record.entry_in_patient,
                                    record.direction_in_patient);
  }
  const auto catalogue = screw_catalogue();
  const bool has_screw = record.screw_index >= 0 && record.screw_advance_mm > 0 &&
                         static_cast<std::size_t>(record.screw_index) < catalogue.size();
  if (facts.line && has_screw) {
    facts.screw = detail::place_screw(scaphoid, data, *facts.line, record,
                                      catalogue[static_cast<std::size_t>(record.screw_index)]);
  }
  ScoreReport report;
  report.must_haves = check_must_haves(facts);
  report.is_fixation_acceptable = std::all_of(report.must_haves.begin(), report.must_haves.end(),
                                              [](const MustHave& must) { return must.fulfilled; });
  facts.is_acceptable = report.is_fixation_acceptable;
  fill_references(report, facts);
  report.placement = picture_of(facts);
  report.items = {
      score_angle(facts),
      score_offset(facts, "waist_offset_mm", "Distance from the axis at the waist", 12,
                   &LinePlacement::at_waist),
      score_offset(facts, "proximal_offset_mm", "Distance at the proximal pole", 8,
                   &LinePlacement::at_proximal),
      score_offset(facts, "distal_offset_mm", "Distance at the distal pole", 8,
                   &LinePlacement::at_distal),
      score_cover(facts, "proximal_cover_mm", "Bone over the screw's tail",
                  &ScrewPlacement::proximal_cover_mm),
      score_cover(facts, "distal_cover_mm", "Bone before the screw's tip",
                  &ScrewPlacement::distal_cover_mm),
      score_penetration(facts),
      score_length(facts, report),
      score_passes(facts),
      score_views(facts),
      score_wrong_bones(facts),
      score_shots(facts),
      score_dose(facts),
      score_time(facts),
      score_undos(facts),
  };
  for (const ScoreItem& item : report.items) report.overall += item.points;
  report.overall = std::clamp(report.overall, 0.0, 100.0);
  return report;
}

}  // namespace carpus::procedure
