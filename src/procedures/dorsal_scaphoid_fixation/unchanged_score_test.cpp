// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Operations that were scored before procedures were declared score the same now.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cases/synthetic_case_test_support.hpp"
#include "procedure/shots.hpp"
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"

namespace carpus::procedures::dorsal_scaphoid_fixation {
namespace {

using Json = nlohmann::json;
constexpr double kSame = 1e-9;

/// The synthetic wrist as it lay in those operations: its radius turned out of the way.
const cases::CaseData& wrist() {
  static const cases::CaseData posed = [] {
    cases::CaseData data = cases::test::synthetic_case();
    const Vec3 pivot{-12, 0, -4};
    const Mat3 turn{{Vec3{1, 0, 0}, Vec3{0, 0.8, -0.6}, Vec3{0, 0.6, 0.8}}};
    for (cases::Bone& bone : data.bones) {
      if (belongs_to_forearm(bone.bone)) bone.patient_from_bone = {turn, pivot - turn * pivot};
    }
    return data;
  }();
  return posed;
}

const Json& corpus() {
  static const Json read = [] {
    std::ifstream file("tests/corpus/score/dorsal_operations.json");
    return Json::parse(file);
  }();
  return read;
}

std::uint8_t body_of(std::uint8_t label) {
  for (std::size_t i = 0; i < wrist().bones.size(); ++i) {
    if (wrist().bones[i].label == label) return static_cast<std::uint8_t>(i);
  }
  ADD_FAILURE() << "no bone of label " << int{label};
  return procedure::kNoBody;
}

Vec3 vector_of(const Json& list, std::size_t from = 0) {
  return {list.at(from).get<double>(), list.at(from + 1).get<double>(),
          list.at(from + 2).get<double>()};
}

/// The record of then in the words of now: the wire is one line, the screw another on the same way;
/// the bones entered belong to the first pass.
procedure::OperationRecord mapped(const Json& old) {
  procedure::OperationRecord record;
  if (old.at("wire_in_scaphoid").get<bool>()) {
    procedure::LineFacts wire;
    wire.instrument = *instruments::instrument_of("guide_wire");
    wire.body = body_of(static_cast<std::uint8_t>(BoneId::Scaphoid));
    wire.in_target = true;
    wire.entry_in_bone = vector_of(old.at("entry_mm"));
    wire.direction_in_bone = vector_of(old.at("direction"));
    wire.depth_mm = old.at("wire_depth_mm").get<double>();
    record.lines.push_back(wire);
    if (!old.at("screw").is_null()) {
      procedure::LineFacts screw = wire;
      screw.instrument = *instruments::instrument_of(old.at("screw").get<std::string>());
      screw.depth_mm = old.at("screw_advance_mm").get<double>();
      record.lines.push_back(screw);
    }
  }
  record.gauge_reading_mm = old.at("measured_mm").get<double>();
  for (unsigned i = 0; i < old.at("passes").get<unsigned>(); ++i) {
    procedure::Pass pass;
    pass.instrument = *instruments::instrument_of("guide_wire");
    pass.bodies_entered = 1U << body_of(static_cast<std::uint8_t>(BoneId::Scaphoid));
    record.passes.push_back(pass);
  }
  for (const Json& label : old.at("wrong_bone_labels")) {
    record.passes.front().bodies_entered |= 1U << body_of(label.get<std::uint8_t>());
  }
  for (const Json& shot : old.at("shots")) {
    procedure::Shot taken;
    taken.rotation_deg = shot.at(0).get<double>();
    taken.tilt_deg = shot.at(1).get<double>();
    taken.completed_steps = shot.at(2).get<unsigned>() << kDriveStep | shot.at(3).get<unsigned>()
                                                                           << kInsertStep;
    record.shots.push_back(taken);
  }
  record.undos = old.at("undos").get<std::uint32_t>();
  record.ticks = old.at("ticks").get<Tick>();
  record.finished = old.at("finished").get<bool>();
  return record;
}

void expect_same(const Json& old, const std::optional<double>& now, const std::string& what) {
  ASSERT_EQ(old.is_null(), !now.has_value()) << what;
  if (now) {
    EXPECT_NEAR(*now, old.get<double>(), kSame) << what;
  }
}

void expect_same(const Json& old, const std::optional<procedure::PlacedLine>& now) {
  ASSERT_EQ(old.is_null(), !now.has_value());
  if (!now) return;
  EXPECT_LT(distance(now->from, vector_of(old)), kSame);
  EXPECT_LT(distance(now->to, vector_of(old, 3)), kSame);
}

void expect_same_items(const Json& old, const procedure::ScoreReport& now) {
  ASSERT_EQ(old.size(), now.items.size());
  for (std::size_t i = 0; i < now.items.size(); ++i) {
    const procedure::ScoreItem& item = now.items[i];
    EXPECT_EQ(item.id, old[i].at(0));
    expect_same(old[i].at(1), item.value, item.id);
    EXPECT_EQ(procedure::name_of(item.grade), old[i].at(2).get<std::string>()) << item.id;
    EXPECT_NEAR(item.points, old[i].at(3).get<double>(), kSame) << item.id;
    EXPECT_NEAR(item.points_possible, old[i].at(4).get<double>(), kSame) << item.id;
    const Json& text = corpus().at("texts").at(old[i].at(5).get<std::size_t>());
    EXPECT_EQ(item.target, text.at(0));
    EXPECT_EQ(item.reason, text.at(1));
  }
}

class EveryOperation : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryOperation, ScoresAsBefore) {
  const Json& operation = corpus().at("operations").at(GetParam());
  SCOPED_TRACE(operation.at("name").get<std::string>());
  const Json& old = operation.at("score");
  const procedure::ScoreReport now = score(wrist(), mapped(operation.at("record")));
  EXPECT_NEAR(now.overall, old.at("overall").get<double>(), kSame);
  EXPECT_EQ(now.is_fixation_acceptable, old.at("fixation_acceptable"));
  for (std::size_t i = 0; i < now.must_haves.size(); ++i) {
    EXPECT_EQ(now.must_haves[i].id, old.at("must_haves").at(i).at(0));
    EXPECT_EQ(now.must_haves[i].fulfilled, old.at("must_haves").at(i).at(1));
  }
  expect_same_items(old.at("items"), now);
  expect_same(old.at("true_length_mm"), now.true_length_mm, "true length");
  expect_same(old.at("gauge_reading_mm"), now.gauge_reading_mm, "gauge reading");
  expect_same(old.at("angle_to_longest_line_deg"), now.angle_to_longest_line_deg, "longest line");
  for (const char* length : {"central_axis_length_mm", "longest_line_mm"}) {
    EXPECT_NEAR(
        std::string(length) == "longest_line_mm" ? now.longest_line_mm : now.central_axis_length_mm,
        corpus().at(length).get<double>(), kSame);
  }
  EXPECT_EQ(now.ideal_screw_index, old.at("ideal_screw_index"));
  EXPECT_EQ(now.ideal_screw, old.at("ideal_screw"));
  EXPECT_EQ(now.chosen_screw_index, old.at("chosen_screw_index"));
  EXPECT_EQ(now.chosen_screw, old.at("chosen_screw"));
  EXPECT_EQ(now.penetration_at, old.at("penetration_at"));
  expect_same(old.at("wire"), now.placement.wire);
  expect_same(old.at("screw"), now.placement.screw);
}

INSTANTIATE_TEST_SUITE_P(All, EveryOperation, testing::Range<std::size_t>(0, 41));

TEST(UnchangedScore, KnowsAllOperations) { EXPECT_EQ(corpus().at("operations").size(), 41U); }

}  // namespace
}  // namespace carpus::procedures::dorsal_scaphoid_fixation
