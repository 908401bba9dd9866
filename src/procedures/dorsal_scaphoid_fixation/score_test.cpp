// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"

namespace carpus::procedures::dorsal_scaphoid_fixation {
namespace {

using instruments::InstrumentIndex;
using procedure::Grade;
using procedure::LineFacts;
using procedure::MustHave;
using procedure::OperationRecord;
using procedure::Pass;
using procedure::ScoreItem;
using procedure::ScoreReport;
using procedure::Shot;

const cases::CaseData& wrist() {
  static const cases::CaseData data = cases::test::synthetic_case();
  return data;
}

InstrumentIndex index_of(const char* id) {
  const auto index = instruments::instrument_of(id);
  EXPECT_TRUE(index.has_value()) << id;
  return index.value_or(0);
}

/// Of the wire in place, or of the screw.
Shot shot_at(double rotation_deg, double tilt_deg, bool of_screw) {
  Shot shot;
  shot.rotation_deg = rotation_deg;
  shot.tilt_deg = tilt_deg;
  shot.shows_wire = !of_screw;
  shot.shows_screw = of_screw;
  return shot;
}

std::uint32_t bit_of(BoneId bone) {
  for (std::size_t i = 0; i < wrist().bones.size(); ++i) {
    if (wrist().bones[i].bone == bone) return 1U << i;
  }
  ADD_FAILURE() << "no such bone";
  return 0;
}

Pass pass_into(std::uint32_t bodies, const char* instrument = "guide_wire") {
  Pass pass;
  pass.instrument = index_of(instrument);
  pass.bodies_entered = bodies;
  return pass;
}

LineFacts& screw_of(OperationRecord& record) { return record.lines.at(0); }

/// Moves the screw.
void shift(OperationRecord& record, const Vec3& by) {
  for (LineFacts& line : record.lines) line.entry_in_bone += by;
}

/// A perfect operation on the synthetic wrist: axis of 27 mm, screw of 22.5 mm, 2.25 mm at each
/// end.
OperationRecord perfect() {
  const auto& axis = wrist().scaphoid.central_axis;
  OperationRecord record;
  LineFacts line;
  line.in_target = true;
  line.entry_in_bone = axis.proximal;
  line.direction_in_bone = normalized_or(axis.distal - axis.proximal, {});
  line.instrument = index_of("acutrak_standard_1994_22_5");
  line.depth_mm = 24.75;
  record.lines.push_back(line);
  record.gauge_reading_mm = 26.5;
  record.passes = {pass_into(bit_of(BoneId::Scaphoid))};
  record.reamed_mm = 25.0;
  record.compression_n = 70.0;
  for (const bool of_screw : {false, true}) {
    for (const auto& [rotation, tilt] :
         {std::pair{0.0, 0.0}, {90.0, 0.0}, {45.0, 0.0}, {0.0, 30.0}}) {
      record.shots.push_back(shot_at(rotation, tilt, of_screw));
    }
  }
  for (const double flexion : {-0.4, 0.4}) {
    record.shots.push_back(shot_at(0, 0, true));
    record.shots.back().look = procedure::Look::Live;
    record.shots.back().wrist.flexion_rad = flexion;
  }
  record.completed_steps = (1U << declared().steps.size()) - 1U;
  record.judgement = procedure::Judgement::Aligned;
  record.ticks = 300000;
  record.finished = true;
  return record;
}

const ScoreItem& item_of(const ScoreReport& report, std::string_view id) {
  for (const ScoreItem& item : report.items) {
    if (item.id == id) return item;
  }
  ADD_FAILURE() << "no item " << id;
  return report.items.front();
}

/// The same operation with the wire through the waist at an angle to the axis.
OperationRecord tilted(double angle_deg) {
  OperationRecord record = perfect();
  const Vec3 side = cases::test::synthetic_scaphoid().rotation.column(0);
  const double angle = radians_from_degrees(angle_deg);
  const Vec3 direction =
      screw_of(record).direction_in_bone * std::cos(angle) + side * std::sin(angle);
  const auto body = cases::test::synthetic_scaphoid();
  // Where the line through the centre enters the ellipsoid.
  const Vec3 q = body.rotation.transposed() * direction;
  const Vec3 k{q.x / body.semi_axes.x, q.y / body.semi_axes.y, q.z / body.semi_axes.z};
  for (LineFacts& line : record.lines) {
    line.entry_in_bone = body.centre - direction / length(k);
    line.direction_in_bone = direction;
  }
  return record;
}

TEST(Score, PointsOfAllItemsMakeAHundred) {
  const ScoreReport report = score(wrist(), perfect());
  double possible = 0;
  for (const ScoreItem& item : report.items) {
    possible += item.points_possible;
    EXPECT_FALSE(item.reason.empty()) << item.id;
    EXPECT_FALSE(item.target.empty()) << item.id;
    EXPECT_LE(item.points, item.points_possible) << item.id;
  }
  EXPECT_DOUBLE_EQ(possible, 100.0);
}

TEST(Score, SpeaksInWordsAndUnits) {
  OperationRecord poor = perfect();
  poor.shots.clear();
  poor.passes = {pass_into(bit_of(BoneId::Trapezium) | bit_of(BoneId::Capitate))};
  for (const OperationRecord& record : {perfect(), poor, OperationRecord{}}) {
    for (const ScoreItem& item : score(wrist(), record).items) {
      for (const std::string& text : {item.label, item.target, item.reason}) {
        EXPECT_EQ(text.find_first_of("_<>="), std::string::npos) << text;
        for (const char* raw : {"+-", "deg ", "cm2", "metacarpal1", " pa ", ": pa", ".."}) {
          EXPECT_EQ(text.find(raw), std::string::npos) << text;
        }
      }
      if (item.unit == "mm" && item.value) {
        EXPECT_NE(item.target.find(" mm"), std::string::npos) << item.id;
      }
    }
  }
}

TEST(Score, APerfectOperationEarnsEverything) {
  const ScoreReport report = score(wrist(), perfect());
  for (const ScoreItem& item : report.items) {
    EXPECT_EQ(item.grade, Grade::Good) << item.id << " " << item.value.value_or(-1);
  }
  EXPECT_NEAR(report.overall, 100.0, 1.0);
  EXPECT_TRUE(report.is_fixation_acceptable);
  EXPECT_NEAR(*report.true_length_mm, 27.0, 0.1);
  EXPECT_NEAR(report.longest_line_mm, 27.0, 0.1);
  EXPECT_EQ(report.ideal_screw, "Acutrak Standard (1994 type) 22.5 mm")
      << "27 - 4 = 23 mm: 22.5 is the longest";
  EXPECT_EQ(report.chosen_screw_index, report.ideal_screw_index);
}

TEST(Score, ALineIsJudgedByItsCorridorAndNotByItsAngle) {
  const ScoreReport slight = score(wrist(), tilted(8));
  EXPECT_NEAR(*item_of(slight, "angle_to_central_axis_deg").value, 8.0, 1e-6);
  EXPECT_EQ(item_of(slight, "angle_to_central_axis_deg").points_possible, 0.0);
  EXPECT_TRUE(slight.is_fixation_acceptable);
  const ScoreReport flat = score(wrist(), tilted(20));
  EXPECT_LT(*item_of(flat, "bone_beside_screw_mm").value,
            *item_of(slight, "bone_beside_screw_mm").value);
  EXPECT_LT(*item_of(flat, "usable_length_percent").value, 90.0);
  EXPECT_LT(flat.overall, slight.overall);
}

TEST(Score, MeasuresTheOffsetAtWaistAndPolesAndSaysWhereTo) {
  OperationRecord record = perfect();
  const Vec3 side = cases::test::synthetic_scaphoid().rotation.column(0);
  shift(record, side * 1.2);
  const ScoreReport report = score(wrist(), record);
  const ScoreItem& waist = item_of(report, "waist_offset_percent");
  EXPECT_NEAR(*waist.value, 100 * 1.2 / 10.37, 0.2) << "the waist is 11.2 x 9.6 mm wide";
  EXPECT_EQ(waist.grade, Grade::Good);
  EXPECT_NE(waist.reason.find("1.2 mm "), std::string::npos) << waist.reason;
  EXPECT_NE(waist.reason.find(" of the middle"), std::string::npos) << waist.reason;
  shift(record, side * 3.0);
  const ScoreReport outer = score(wrist(), record);
  EXPECT_EQ(item_of(outer, "waist_offset_percent").grade, Grade::Fail);
  EXPECT_FALSE(outer.is_fixation_acceptable);
  EXPECT_EQ(outer.overall, 0.0) << "nothing earns points without a safe fixation";
}

TEST(Score, MeasuresTheCoverAtBothEnds) {
  OperationRecord record = perfect();
  screw_of(record).depth_mm = 22.5 + 0.2;  // the tail 0.2 mm under the surface
  ScoreReport report = score(wrist(), record);
  EXPECT_NEAR(*item_of(report, "proximal_cover_mm").value, 0.2, 0.05);
  EXPECT_EQ(item_of(report, "proximal_cover_mm").grade, Grade::Fail);
  EXPECT_NEAR(*item_of(report, "distal_cover_mm").value, 4.3, 0.1);
  EXPECT_EQ(item_of(report, "distal_cover_mm").grade, Grade::Acceptable);
  EXPECT_FALSE(report.is_fixation_acceptable);
}

TEST(Score, FindsAScrewThatStandsOut) {
  OperationRecord record = perfect();
  screw_of(record).instrument = index_of("acutrak_standard_1994_30");
  screw_of(record).depth_mm = 32.0;
  ScoreReport report = score(wrist(), record);
  EXPECT_NEAR(*item_of(report, "penetration_mm").value, 5.0, 0.3);
  EXPECT_EQ(report.penetration_at.substr(0, 6), "distal");
  EXPECT_EQ(item_of(report, "penetration_mm").grade, Grade::Fail);
  EXPECT_EQ(item_of(report, "screw_length_minus_ideal_mm").grade, Grade::Fail);
  EXPECT_NEAR(*item_of(report, "screw_length_minus_ideal_mm").value, 7.5, 1e-9);

  record = perfect();  // beside the axis the threads come through the side
  shift(record, cases::test::synthetic_scaphoid().rotation.column(1) * 4.0);
  report = score(wrist(), record);
  EXPECT_GT(*item_of(report, "penetration_mm").value, 0.5);
}

TEST(Score, DoingNothingEarnsNothing) {
  OperationRecord nothing;
  nothing.ticks = 1000;
  nothing.finished = true;
  EXPECT_FALSE(score(wrist(), nothing).is_fixation_acceptable);
  EXPECT_EQ(score(wrist(), nothing).overall, 0.0);
  for (const MustHave& must : score(wrist(), nothing).must_haves) {
    const bool is_of_a_screw = must.id == "screw_holds" || must.id == "waist";
    if (is_of_a_screw) {
      EXPECT_FALSE(must.fulfilled) << must.id << ": there is no screw";
      EXPECT_TRUE(must.not_measured) << must.id;
    }
    if (must.id == "screw_placed") {
      EXPECT_FALSE(must.not_measured) << "that none is in is known";
    }
  }
  nothing.stripped_screws = 1;
  for (const MustHave& must : score(wrist(), nothing).must_haves) {
    if (must.id == "screw_holds") {
      EXPECT_FALSE(must.not_measured) << "stripped, and taken out";
    }
  }

  OperationRecord fewer = perfect();
  fewer.shots.resize(2);
  EXPECT_LT(score(wrist(), fewer).overall, score(wrist(), perfect()).overall);
}

TEST(Score, OneHarmAndTheFixationIsNotAcceptable) {
  std::vector<std::pair<const char*, OperationRecord>> harmed;
  const auto add = [&](const char* what) -> OperationRecord& {
    return harmed.emplace_back(what, perfect()).second;
  };
  add("a capitate drilled and taken back").passes.push_back(pass_into(bit_of(BoneId::Capitate)));
  harmed.back().second.passes.back().was_undone = true;
  add("a drill 9 mm out of the far cortex").passes.front().follower_exit_mm = 9.0;
  add("a wire broken").broken_wires = 1;
  add("a screw turned on until it stripped").stripped_screws = 1;
  add("a screw too long").lines.front().depth_mm = 28.0;
  LineFacts wire = screw_of(harmed.back().second);
  wire.instrument = index_of("guide_wire");
  add("a wire left in").lines.push_back(wire);
  screw_of(add("a screw beside the waist")).entry_in_bone +=
      cases::test::synthetic_scaphoid().rotation.column(0) * 4.0;
  add("no screw").lines.clear();
  add("pieces left with a step").fracture = {true, 0.5, 4.0, 1.0};
  add("pieces left with a gap").fracture = {true, 4.0, 0.5, 1.0};
  for (const auto& [what, record] : harmed) {
    const ScoreReport report = score(wrist(), record);
    EXPECT_FALSE(report.is_fixation_acceptable) << what;
    EXPECT_EQ(report.overall, 0.0) << what;
  }
}

TEST(Score, ViewsCountOnlyOnceWireOrScrewAreIn) {
  OperationRecord record = perfect();
  for (Shot& shot : record.shots) shot.shows_wire = shot.shows_screw = false;
  const ScoreReport report = score(wrist(), record);
  EXPECT_EQ(*item_of(report, "views_with_wire").value, 0.0);
  EXPECT_EQ(*item_of(report, "views_with_screw").value, 0.0);
}

TEST(Score, AWireMayGoThroughAndABentOneIsTold) {
  OperationRecord record = perfect();
  record.passes.front().far_exit_mm = 120.0;
  const double through = score(wrist(), record).overall;
  EXPECT_EQ(through, score(wrist(), perfect()).overall) << "it is meant to be drawn through";
  record.most_bend_rad = 0.3;
  const ScoreReport bent = score(wrist(), record);
  EXPECT_NEAR(*item_of(bent, "wire_bend_deg").value, 17.2, 0.05);
  EXPECT_EQ(item_of(bent, "wire_bend_deg").grade, Grade::Fail) << "told, not counted";
}

TEST(Score, WhatIsSaidOfTheFractureIsHeldAgainstHowItLay) {
  OperationRecord record = perfect();
  EXPECT_EQ(*item_of(score(wrist(), record), "judgement_right").value, 1.0);
  record.fracture_at_first = {true, 0.4, 2.4, 0.99};
  const ScoreItem wrong = item_of(score(wrist(), record), "judgement_right");
  EXPECT_EQ(*wrong.value, 0.0);
  EXPECT_NE(wrong.reason.find("Said: aligned; it was displaced."), std::string::npos);
  record.judgement = procedure::Judgement::Displaced;
  EXPECT_EQ(*item_of(score(wrist(), record), "judgement_right").value, 1.0);
  record.judgement = procedure::Judgement::None;
  EXPECT_EQ(*item_of(score(wrist(), record), "judgement_right").value, 0.0) << "nothing was said";
}

TEST(Score, AWireThatIsOutAtOneEndAloneMayComeWithTheDrill) {
  OperationRecord record = perfect();
  EXPECT_EQ(*item_of(score(wrist(), record), "wire_held_while_reaming").value, 1.0);
  record.unheld_ream_mm = 12.0;
  EXPECT_EQ(*item_of(score(wrist(), record), "wire_held_while_reaming").value, 0.0);
  record.reamed_mm = 0.0;
  EXPECT_FALSE(item_of(score(wrist(), record), "wire_held_while_reaming").value.has_value());
}

TEST(Score, AScrewIsSeenInMotionByLivePicturesAlone) {
  OperationRecord record = perfect();
  EXPECT_GE(*item_of(score(wrist(), record), "seen_in_motion_deg").value, 40.0);
  for (Shot& shot : record.shots) shot.look = procedure::Look::Single;
  EXPECT_EQ(*item_of(score(wrist(), record), "seen_in_motion_deg").value, 0.0);
}

TEST(Score, AWayOutAtTheSideIsNoneAtThePole) {
  OperationRecord record = perfect();
  record.passes.front().far_exits = 1;
  record.passes.front().shortest_exit_mm = 26.0;
  EXPECT_EQ(*item_of(score(wrist(), record), "side_exits").value, 0.0);
  record.passes.front().shortest_exit_mm = 12.0;
  EXPECT_EQ(*item_of(score(wrist(), record), "side_exits").value, 1.0);
}

TEST(Score, StepsOutOfTheirOrderAreNamed) {
  OperationRecord record = perfect();
  const std::size_t count = declared().steps.size();
  for (std::size_t i = 0; i < count; ++i) record.first_done.push_back(10 * (i + 1));
  EXPECT_EQ(*item_of(score(wrist(), record), "steps_out_of_order").value, 0.0);
  record.first_done[3] = 0;  // left out
  record.first_done[5] = record.first_done[4];
  EXPECT_EQ(*item_of(score(wrist(), record), "steps_out_of_order").value, 0.0);
  record.first_done[0] = 175;  // surveyed after all but the last
  const ScoreItem late = item_of(score(wrist(), record), "steps_out_of_order");
  EXPECT_EQ(*late.value, 1.0) << "one step, however far it was moved";
  EXPECT_NE(late.reason.find(declared().steps[0].title), std::string::npos) << late.reason;
}

TEST(Score, TwoWaysOutAreMeantAndEachFurtherOneCosts) {
  OperationRecord record = perfect();
  record.passes.front().far_exits = 2;
  EXPECT_EQ(item_of(score(wrist(), record), "far_exits").grade, Grade::Good);
  record.passes.push_back(record.passes.front());
  record.passes.back().was_undone = true;
  record.passes.back().far_exits = 3;
  const ScoreItem out = item_of(score(wrist(), record), "far_exits");
  EXPECT_EQ(*out.value, 5.0) << "what is undone counts";
  EXPECT_EQ(out.grade, Grade::Fail);
  EXPECT_NE(out.reason.find("5 times"), std::string::npos) << out.reason;
}

TEST(Score, TheGaugeIsHeldAgainstTheBone) {
  OperationRecord record = perfect();
  EXPECT_NEAR(*item_of(score(wrist(), record), "gauge_minus_line_mm").value, -0.5, 0.1);
  record.gauge_reading_mm = 33.0;
  const ScoreItem beyond = item_of(score(wrist(), record), "gauge_minus_line_mm");
  EXPECT_NEAR(*beyond.value, 6.0, 0.1);
  EXPECT_EQ(beyond.grade, Grade::Fail);
  EXPECT_NE(beyond.reason.find("6.0 mm beyond the far cortex"), std::string::npos) << beyond.reason;
  record.gauge_reading_mm = 24.0;
  const ScoreItem before = item_of(score(wrist(), record), "gauge_minus_line_mm");
  EXPECT_EQ(before.grade, Grade::Acceptable);
  EXPECT_NE(before.reason.find("before the far cortex"), std::string::npos) << before.reason;
  record.gauge_reading_mm = -1.0;
  EXPECT_EQ(item_of(score(wrist(), record), "gauge_minus_line_mm").points, 0.0) << "never measured";
}

TEST(Score, CountsPassesAndUndos) {
  OperationRecord record = perfect();
  record.passes.assign(5, pass_into(bit_of(BoneId::Scaphoid)));
  record.passes.front().was_undone = true;
  record.passes.push_back(pass_into(bit_of(BoneId::Scaphoid), "cannulated_drill"));
  record.undos = 3;
  const ScoreReport report = score(wrist(), record);
  EXPECT_EQ(item_of(report, "wire_passes").grade, Grade::Fail);
  EXPECT_EQ(*item_of(report, "wire_passes").value, 5.0)
      << "what is undone counts, a drill does not";
  EXPECT_EQ(item_of(report, "undos").grade, Grade::Fail);
}

TEST(Score, WhatWasSkippedIsTold) {
  OperationRecord record = perfect();
  record.completed_steps &= ~1U;
  const ScoreReport report = score(wrist(), record);
  EXPECT_EQ(*item_of(report, "steps_left_out").value, 1.0);
  EXPECT_NE(item_of(report, "steps_left_out").reason.find("Survey"), std::string::npos);
}

TEST(Score, WiresThatTakeNoScrewAndLinesBesideTheBoneDoNotCount) {
  OperationRecord record = perfect();
  LineFacts joystick = screw_of(record);
  joystick.instrument = index_of("joystick_wire");
  joystick.direction_in_bone = cases::test::synthetic_scaphoid().rotation.column(0);
  record.lines.push_back(joystick);
  EXPECT_NEAR(*item_of(score(wrist(), record), "angle_to_central_axis_deg").value, 0.0, 1e-6);
}

}  // namespace
}  // namespace carpus::procedures::dorsal_scaphoid_fixation
