// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures without a published source are engineering proposals and marked so in docs/scoring.md.
#include "procedures/scaphoid_fixation/score_items.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "anatomy/bone_words.hpp"
#include "procedure/score_items.hpp"
#include "procedures/scaphoid_fixation/views.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using procedure::falling_points;
using procedure::Grade;
using procedure::grade_falling;
using procedure::make_item;
using procedure::ScoreItem;
using procedure::ScoreReport;
using procedure::text_of;

constexpr const char* kNoWire = "No wire lies in the scaphoid: there is nothing to measure.";
constexpr const char* kNoScrew = "No screw lies in the scaphoid: there is nothing to measure.";

ScoreItem offset_item(const Facts& facts,
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

ScoreItem cover_item(const Facts& facts,
                     const char* id,
                     const char* label,
                     double possible,
                     double ScrewPlacement::*which) {
  constexpr double kTargetMm = 2.0;
  constexpr double kGoodWithinMm = 0.75;
  constexpr double kFailMm = 0.5;
  constexpr double kTooDeepMm = 6.0;
  ScoreItem item = make_item(id, label, "mm", possible);
  item.target = "2 ± 0.75 mm good, under 0.5 mm fail";
  item.reason = kNoScrew;
  if (!facts.placed) return item;
  const double cover = (*facts.placed).*which;
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

}  // namespace

ScoreItem angle_item(const Facts& facts, double points) {
  ScoreItem item =
      make_item("angle_to_central_axis_deg", "Angle to the central axis", "deg", points);
  item.target = "at most 5° good, over 15° fail";
  item.reason = kNoWire;
  if (!facts.line) return item;
  grade_falling(item, facts.line->angle_deg, 5.0, 15.0);
  item.reason =
      "A screw along the central axis holds the fracture stiffest and has the longest way in bone "
      "before it can come out.";
  return item;
}

ScoreItem waist_item(const Facts& facts, double points) {
  return offset_item(facts, "waist_offset_mm", "Distance from the axis at the waist", points,
                     &LinePlacement::at_waist);
}

ScoreItem proximal_offset_item(const Facts& facts, double points) {
  return offset_item(facts, "proximal_offset_mm", "Distance at the proximal pole", points,
                     &LinePlacement::at_proximal);
}

ScoreItem distal_offset_item(const Facts& facts, double points) {
  return offset_item(facts, "distal_offset_mm", "Distance at the distal pole", points,
                     &LinePlacement::at_distal);
}

ScoreItem proximal_cover_item(const Facts& facts, double points) {
  const bool is_tail = facts.rules.approach == Approach::FromProximal;
  return cover_item(facts, "proximal_cover_mm",
                    is_tail ? "Bone over the screw's tail" : "Bone before the screw's tip", points,
                    is_tail ? &ScrewPlacement::tail_cover_mm : &ScrewPlacement::tip_cover_mm);
}

ScoreItem distal_cover_item(const Facts& facts, double points) {
  const bool is_tip = facts.rules.approach == Approach::FromProximal;
  return cover_item(facts, "distal_cover_mm",
                    is_tip ? "Bone before the screw's tip" : "Bone over the screw's tail", points,
                    is_tip ? &ScrewPlacement::tip_cover_mm : &ScrewPlacement::tail_cover_mm);
}

ScoreItem penetration_item(const Facts& facts, double points) {
  ScoreItem item = make_item("penetration_mm", "Screw outside the bone", "mm", points);
  item.target = "0 mm good, over 0.5 mm fail";
  item.reason = kNoScrew;
  if (!facts.placed) return item;
  const double depth = facts.placed->penetration_mm;
  item.value = depth;
  item.grade = depth <= 0.0 ? Grade::Good : (depth > 0.5 ? Grade::Fail : Grade::Acceptable);
  item.points = falling_points(depth, 0.0, 0.5, item.points_possible);
  item.reason = depth > 0
                    ? "The screw stands out of the bone: " + facts.placed->penetration_at + "."
                    : "No part of the screw stands out of the scaphoid.";
  return item;
}

ScoreItem length_item(const Facts& facts, const ScoreReport& report, double points) {
  ScoreItem item =
      make_item("screw_length_minus_ideal_mm", "Screw length against ideal", "mm", points);
  item.target = "0 mm good; longer than ideal, or more than 4 mm shorter, fail";
  item.reason = kNoScrew;
  const auto catalogue = instruments::catalogue();
  if (!facts.placed) return item;
  if (!report.true_length_mm || report.ideal_screw_index < 0) {
    item.grade = Grade::Fail;
    item.reason = "On this line the bone is too short for any screw on the tray.";
    return item;
  }
  const double chosen = catalogue[facts.screw->instrument].length_mm;
  const double ideal =
      catalogue[facts.screws[static_cast<std::size_t>(report.ideal_screw_index)]].length_mm;
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

ScoreItem passes_item(const Facts& facts, double points) {
  ScoreItem item = make_item("wire_passes", "Wire passes", "1", points);
  item.target = "1 pass good, over 3 fail";
  if (facts.wire_passes == 0) {
    item.reason = kNoWire;
    return item;
  }
  grade_falling(item, facts.wire_passes, 1.0, 3.0);
  item.reason = "Each pass takes bone in which the screw is to hold, and cartilage at the entry.";
  return item;
}

ScoreItem views_item(const Facts& facts, double points) {
  ScoreItem item = make_item("required_views_seen", "Required views before the end", "1", points);
  item.target = "all 4 good (PA, lateral, 45° pronated oblique, proximal pole), under 3 fail";
  const std::uint32_t in_place = 1U << facts.rules.drive_step | 1U << facts.rules.insert_step;
  const unsigned seen = views_after(facts.record, in_place);
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

ScoreItem wrong_bones_item(const Facts& facts, double points) {
  ScoreItem item = make_item("wrong_bones_entered", "Other bones entered", "1", points);
  item.target = "none good, any fail";
  if (facts.wire_passes == 0 && facts.entered.empty()) {
    item.reason = kNoWire;
    return item;
  }
  const auto& allowed = facts.rules.procedure->allowed;
  std::vector<BoneId> wrong;
  std::copy_if(facts.entered.begin(), facts.entered.end(), std::back_inserter(wrong),
               [&](BoneId bone) {
                 return std::find(allowed.begin(), allowed.end(), bone) == allowed.end();
               });
  item.value = static_cast<double>(wrong.size());
  item.grade = wrong.empty() ? Grade::Good : Grade::Fail;
  item.points = wrong.empty() ? item.points_possible : 0.0;
  item.reason = "The wire should enter no bone but the scaphoid";
  for (const BoneId bone : allowed) {
    item.reason += " and, where it must, the ";
    item.reason += words_of(bone);
  }
  item.reason += ".";
  for (const BoneId bone : wrong) {
    item.reason += " Entered: the ";
    item.reason += words_of(bone);
    item.reason += ".";
  }
  return item;
}

std::vector<ScoreItem> thrift_items(const Facts& facts,
                                    double shots,
                                    double dose,
                                    double time,
                                    double undos) {
  return {
      procedure::shots_item(facts.record, facts.is_acceptable, shots, views_taken(facts.record)),
      procedure::dose_item(facts.record, facts.is_acceptable, dose),
      procedure::time_item(facts.record, facts.is_acceptable, time),
      procedure::undos_item(facts.record, facts.wire_passes > 0, kNoWire, undos)};
}

}  // namespace carpus::procedures::scaphoid_fixation
