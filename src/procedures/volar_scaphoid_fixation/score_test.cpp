// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "cases/synthetic_case_test_support.hpp"
#include "procedures/volar_scaphoid_fixation/declared.hpp"

namespace carpus::procedures::volar_scaphoid_fixation {
namespace {

using procedure::Grade;
using procedure::LineFacts;
using procedure::OperationRecord;
using procedure::Pass;
using procedure::ScoreItem;
using procedure::ScoreReport;

const cases::CaseData& wrist() {
  static const cases::CaseData data = cases::test::synthetic_case();
  return data;
}

std::uint32_t bit_of(BoneId bone) {
  for (std::size_t i = 0; i < wrist().bones.size(); ++i) {
    if (wrist().bones[i].bone == bone) return 1U << i;
  }
  return 0;
}

/// Along the axis of 27 mm, in at its distal end, 2.25 mm of bone at either end of the screw.
OperationRecord perfect() {
  const auto& axis = wrist().scaphoid.central_axis;
  OperationRecord record;
  LineFacts line;
  line.in_target = true;
  line.entry_in_bone = axis.distal;
  line.direction_in_bone = normalized_or(axis.proximal - axis.distal, {});
  line.instrument = *instruments::instrument_of("acutrak_standard_1994_22_5");
  line.depth_mm = 24.75;
  record.lines.push_back(line);
  record.gauge_reading_mm = 26.5;
  record.reamed_mm = 25.0;
  record.compression_n = 70.0;
  record.judgement = procedure::Judgement::Aligned;
  for (const double flexion : {-0.4, 0.4}) {
    procedure::Shot live;
    live.look = procedure::Look::Live;
    live.shows_screw = true;
    live.wrist.flexion_rad = flexion;
    record.shots.push_back(live);
  }
  Pass pass;
  pass.instrument = *instruments::instrument_of("guide_wire");
  pass.bodies_entered = bit_of(BoneId::Scaphoid);
  record.passes = {pass};
  for (const auto& [rotation, tilt] :
       {std::pair{0.0, 0.0}, {90.0, 0.0}, {45.0, 0.0}, {0.0, -60.0}}) {
    procedure::Shot shot;
    shot.rotation_deg = rotation;
    shot.tilt_deg = tilt;
    shot.shows_wire = true;
    record.shots.push_back(shot);
    shot.shows_screw = true;
    record.shots.push_back(shot);
  }
  record.completed_steps = (1U << declared().steps.size()) - 1U;
  record.ticks = 300000;
  record.finished = true;
  return record;
}

ScoreItem item_of(const ScoreReport& report, std::string_view id) {
  for (const ScoreItem& item : report.items) {
    if (item.id == id) return item;
  }
  ADD_FAILURE() << "no item " << id;
  return report.items.front();
}

TEST(VolarScore, APerfectOperationEarnsEverything) {
  const ScoreReport report = score(wrist(), perfect());
  for (const ScoreItem& item : report.items) {
    EXPECT_EQ(item.grade, Grade::Good) << item.id << " " << item.value.value_or(-1);
    EXPECT_FALSE(item.reason.empty() || item.target.empty()) << item.id;
  }
  EXPECT_NEAR(report.overall, 100.0, 1e-9);
  EXPECT_TRUE(report.is_fixation_acceptable);
  EXPECT_NEAR(*report.true_length_mm, 27.0, 0.1);
}

TEST(VolarScore, TipAndTailHaveChangedPoles) {
  OperationRecord record = perfect();
  record.lines.front().depth_mm = 26.5;  // 0.5 mm short of the proximal pole
  const ScoreReport report = score(wrist(), record);
  EXPECT_NEAR(*item_of(report, "proximal_cover_mm").value, 0.5, 0.05);
  EXPECT_NE(item_of(report, "proximal_cover_mm").reason.find("tip is here"), std::string::npos);
  EXPECT_NEAR(*item_of(report, "distal_cover_mm").value, 4.0, 0.05);
  record.lines.front().depth_mm = 30.0;
  const ScoreReport through = score(wrist(), record);
  EXPECT_EQ(through.penetration_at.substr(0, 8), "proximal");
}

TEST(VolarScore, TheDrillStopsTwoMillimetresBeforeTheFarCortex) {
  OperationRecord record = perfect();
  EXPECT_NEAR(*item_of(score(wrist(), record), "ream_short_of_far_cortex_mm").value, 2.0, 0.05);
  record.reamed_mm = 27.5;  // came through
  const ScoreItem through = item_of(score(wrist(), record), "ream_short_of_far_cortex_mm");
  EXPECT_EQ(through.grade, Grade::Fail);
  EXPECT_EQ(through.points, 0.0);
  record.reamed_mm = 21.0;
  EXPECT_EQ(item_of(score(wrist(), record), "ream_short_of_far_cortex_mm").grade,
            Grade::Acceptable);
  record.reamed_mm = 0.0;
  const ScoreItem none = item_of(score(wrist(), record), "ream_short_of_far_cortex_mm");
  EXPECT_EQ(none.grade, Grade::NotMeasured);
  EXPECT_EQ(none.points, 0.0);
}

TEST(VolarScore, TheTrapeziumMayBeEnteredAtTheCostOfItsCartilage) {
  OperationRecord record = perfect();
  record.passes.front().bodies_entered |= bit_of(BoneId::Trapezium);
  const ScoreReport report = score(wrist(), record);
  EXPECT_EQ(item_of(report, "wrong_bones_entered").grade, Grade::Good);
  const ScoreItem cartilage = item_of(report, "trapezium_cartilage_mm2");
  EXPECT_NEAR(*cartilage.value, 3.14159 * 1.9 * 1.9, 1e-3) << "as wide as the screw's tail";
  EXPECT_EQ(cartilage.grade, Grade::Acceptable);
  EXPECT_TRUE(report.is_fixation_acceptable);

  record.passes.insert(record.passes.begin(), record.passes.front());
  EXPECT_NEAR(*item_of(score(wrist(), record), "trapezium_cartilage_mm2").value,
              3.14159 * (1.9 * 1.9 + 0.57 * 0.57), 1e-3);
  record.passes.back().bodies_entered |= bit_of(BoneId::Capitate);
  EXPECT_EQ(item_of(score(wrist(), record), "wrong_bones_entered").grade, Grade::Fail);
}

TEST(VolarScore, OneHarmAndTheFixationIsNotAcceptable) {
  std::vector<std::pair<const char*, OperationRecord>> harmed;
  const auto add = [&](const char* what) -> OperationRecord& {
    return harmed.emplace_back(what, perfect()).second;
  };
  add("the wire 9 mm into the radiocarpal joint, taken back").passes.front().far_exit_mm = 9.0;
  harmed.back().second.passes.front().was_undone = true;
  add("the drill as far").passes.front().follower_exit_mm = 9.0;
  add("a capitate drilled").passes.front().bodies_entered |= bit_of(BoneId::Capitate);
  add("a wire broken").broken_wires = 1;
  add("a screw turned on until it stripped").stripped_screws = 1;
  add("a screw through the proximal pole").lines.front().depth_mm = 28.0;
  LineFacts wire = perfect().lines.front();
  wire.instrument = *instruments::instrument_of("guide_wire");
  add("a wire left in").lines.push_back(wire);
  add("no screw").lines.clear();
  add("pieces left with a step").fracture = {true, 0.5, 4.0, 1.0};
  ASSERT_TRUE(score(wrist(), perfect()).is_fixation_acceptable);
  for (const auto& [what, record] : harmed) {
    const ScoreReport report = score(wrist(), record);
    EXPECT_FALSE(report.is_fixation_acceptable) << what;
    EXPECT_EQ(report.overall, 0.0) << what;
  }
}

TEST(VolarScore, AWireFromTheOtherPoleHasTheWrongDirection) {
  OperationRecord record = perfect();
  for (LineFacts& line : record.lines) {
    line.entry_in_bone = wrist().scaphoid.central_axis.proximal;
    line.direction_in_bone = -line.direction_in_bone;
  }
  EXPECT_NEAR(*item_of(score(wrist(), record), "angle_to_central_axis_deg").value, 180.0, 1e-6);
}

}  // namespace
}  // namespace carpus::procedures::volar_scaphoid_fixation
