// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"
#include "procedure/screw_catalogue.hpp"

namespace carpus::procedure {
namespace {

const cases::CaseData& wrist() {
  static const cases::CaseData data = cases::test::synthetic_case();
  return data;
}

int screw_of(double length_mm) {
  const auto catalogue = screw_catalogue();
  for (std::size_t i = 0; i < catalogue.size(); ++i) {
    if (catalogue[i].length_mm == length_mm) return static_cast<int>(i);
  }
  return -1;
}

Shot shot_at(double rotation_deg, double tilt_deg) {
  return {rotation_deg, tilt_deg, 0, true, true};
}

/// A perfect operation on the synthetic wrist: axis of 27 mm, screw of 22.5 mm, 2.25 mm at each
/// end.
OperationRecord perfect() {
  const auto& axis = wrist().scaphoid.central_axis;
  OperationRecord record;
  record.wire_in_scaphoid = true;
  record.entry_in_patient = axis.proximal;
  record.direction_in_patient = normalized_or(axis.distal - axis.proximal, {});
  record.wire_depth_mm = 26.5;
  record.measured_mm = 26.5;
  record.screw_index = screw_of(22.5);
  record.screw_advance_mm = 24.75;
  record.passes = 1;
  record.shots = {shot_at(0, 0), shot_at(90, 0), shot_at(45, 0), shot_at(0, 30)};
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
  const Vec3 direction = record.direction_in_patient * std::cos(angle) + side * std::sin(angle);
  const auto body = cases::test::synthetic_scaphoid();
  // Where the line through the centre enters the ellipsoid.
  const Vec3 q = body.rotation.transposed() * direction;
  const Vec3 k{q.x / body.semi_axes.x, q.y / body.semi_axes.y, q.z / body.semi_axes.z};
  record.entry_in_patient = body.centre - direction / length(k);
  record.direction_in_patient = direction;
  return record;
}

TEST(Score, PointsOfAllItemsMakeAHundred) {
  const ScoreReport report = score_operation(wrist(), perfect());
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
  poor.wrong_bones = (1U << static_cast<unsigned>(BoneId::Metacarpal1)) |
                     (1U << static_cast<unsigned>(BoneId::Capitate));
  for (const OperationRecord& record : {perfect(), poor, OperationRecord{}}) {
    for (const ScoreItem& item : score_operation(wrist(), record).items) {
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
  const ScoreReport report = score_operation(wrist(), perfect());
  for (const ScoreItem& item : report.items) {
    EXPECT_EQ(item.grade, Grade::Good) << item.id << " " << item.value.value_or(-1);
  }
  EXPECT_NEAR(report.overall, 100.0, 1.0);
  EXPECT_TRUE(report.is_fixation_acceptable);
  EXPECT_NEAR(*report.true_length_mm, 27.0, 0.1);
  EXPECT_NEAR(report.longest_line_mm, 27.0, 0.1);
  EXPECT_EQ(report.ideal_screw_index, screw_of(22.5)) << "27 - 4 = 23 mm: 22.5 is the longest";
}

TEST(Score, MeasuresTheAngle) {
  for (const double angle : {3.0, 8.0, 20.0}) {
    const ScoreReport report = score_operation(wrist(), tilted(angle));
    EXPECT_NEAR(*item_of(report, "angle_to_central_axis_deg").value, angle, 1e-6);
  }
  EXPECT_EQ(item_of(score_operation(wrist(), tilted(3)), "angle_to_central_axis_deg").grade,
            Grade::Good);
  EXPECT_EQ(item_of(score_operation(wrist(), tilted(8)), "angle_to_central_axis_deg").grade,
            Grade::Acceptable);
  const ScoreReport flat = score_operation(wrist(), tilted(20));
  EXPECT_EQ(item_of(flat, "angle_to_central_axis_deg").grade, Grade::Fail);
  EXPECT_FALSE(flat.is_fixation_acceptable);
}

TEST(Score, MeasuresTheOffsetAtWaistAndPoles) {
  OperationRecord record = perfect();
  const Vec3 side = cases::test::synthetic_scaphoid().rotation.column(0);
  record.entry_in_patient += side * 1.2;
  const ScoreReport report = score_operation(wrist(), record);
  const ScoreItem& waist = item_of(report, "waist_offset_mm");
  EXPECT_NEAR(*waist.value, 1.2, 1e-6);
  EXPECT_EQ(waist.grade, Grade::Good) << "the waist is 10.4 mm wide, a sixth of it 1.7";
  EXPECT_NEAR(*item_of(report, "proximal_offset_mm").value, 1.2, 1e-6);
  record.entry_in_patient += side * 3.0;
  const ScoreReport outer = score_operation(wrist(), record);
  EXPECT_EQ(item_of(outer, "waist_offset_mm").grade, Grade::Fail);
  EXPECT_FALSE(outer.is_fixation_acceptable);
}

TEST(Score, MeasuresTheCoverAtBothEnds) {
  OperationRecord record = perfect();
  record.screw_advance_mm = 22.5 + 0.2;  // the tail 0.2 mm under the surface
  ScoreReport report = score_operation(wrist(), record);
  EXPECT_NEAR(*item_of(report, "proximal_cover_mm").value, 0.2, 0.05);
  EXPECT_EQ(item_of(report, "proximal_cover_mm").grade, Grade::Fail);
  EXPECT_NEAR(*item_of(report, "distal_cover_mm").value, 4.3, 0.1);
  EXPECT_EQ(item_of(report, "distal_cover_mm").grade, Grade::Acceptable);
  EXPECT_FALSE(report.is_fixation_acceptable);
}

TEST(Score, FindsAScrewThatStandsOut) {
  OperationRecord record = perfect();
  record.screw_index = screw_of(30.0);
  record.screw_advance_mm = 32.0;
  ScoreReport report = score_operation(wrist(), record);
  EXPECT_NEAR(*item_of(report, "penetration_mm").value, 5.0, 0.3);
  EXPECT_EQ(report.penetration_at.substr(0, 6), "distal");
  EXPECT_EQ(item_of(report, "penetration_mm").grade, Grade::Fail);
  EXPECT_EQ(item_of(report, "screw_length_minus_ideal_mm").grade, Grade::Fail);
  EXPECT_NEAR(*item_of(report, "screw_length_minus_ideal_mm").value, 7.5, 1e-9);

  record = perfect();  // beside the axis the threads come through the side
  record.entry_in_patient += cases::test::synthetic_scaphoid().rotation.column(1) * 4.0;
  report = score_operation(wrist(), record);
  EXPECT_GT(*item_of(report, "penetration_mm").value, 0.5);
}

TEST(Score, FewShotsAloneEarnNothing) {
  OperationRecord nothing;
  nothing.ticks = 1000;
  nothing.finished = true;
  const ScoreReport report = score_operation(wrist(), nothing);
  for (const char* id : {"shots", "dose_cgy_cm2", "time_s"}) {
    EXPECT_EQ(item_of(report, id).points, 0.0) << id;
  }
  EXPECT_FALSE(report.is_fixation_acceptable);
  EXPECT_EQ(report.overall, 0.0);

  OperationRecord fewer = perfect();
  fewer.shots.resize(2);
  EXPECT_LT(score_operation(wrist(), fewer).overall, score_operation(wrist(), perfect()).overall);
}

TEST(Score, RequiredViewsCountOnlyOnceTheWireIsIn) {
  OperationRecord record = perfect();
  for (Shot& shot : record.shots) shot.wire_in_bone = shot.screw_in = false;
  const ScoreReport report = score_operation(wrist(), record);
  EXPECT_EQ(*item_of(report, "required_views_seen").value, 0.0);
}

TEST(Score, CountsPassesWrongBonesAndUndos) {
  OperationRecord record = perfect();
  record.passes = 5;
  record.undos = 3;
  record.wrong_bones = 1U << static_cast<unsigned>(BoneId::Trapezium);
  const ScoreReport report = score_operation(wrist(), record);
  EXPECT_EQ(item_of(report, "wire_passes").grade, Grade::Fail);
  EXPECT_EQ(item_of(report, "undos").grade, Grade::Fail);
  EXPECT_EQ(item_of(report, "wrong_bones_entered").grade, Grade::Fail);
  EXPECT_NE(item_of(report, "wrong_bones_entered").reason.find("trapezium"), std::string::npos);
}

TEST(ScrewCatalogue, HoldsATrayAndSaysWhatIsUnconfirmed) {
  ASSERT_GE(screw_catalogue().size(), 10U);
  for (const Screw& screw : screw_catalogue()) EXPECT_FALSE(screw.confirmed);
}

TEST(ScrewCatalogue, IdealIsTheLongestThatLeavesFourMillimetres) {
  const auto catalogue = screw_catalogue();
  const auto ideal = [&](double measured) {
    const int index = ideal_screw_index(catalogue, measured);
    return index < 0 ? -1.0 : catalogue[static_cast<std::size_t>(index)].length_mm;
  };
  EXPECT_EQ(ideal(28.0), 24.0);
  EXPECT_EQ(ideal(27.99), 22.5);
  EXPECT_EQ(ideal(16.0), -1.0);
  EXPECT_EQ(ideal(60.0), 30.0);
}

TEST(Views, AreRangesOfTheTwoAngles) {
  EXPECT_TRUE(shows(View::Pa, 0, 0));
  EXPECT_TRUE(shows(View::Pa, 180, 0)) << "the same contours from the other side";
  EXPECT_TRUE(shows(View::Lateral, -90, 0));
  EXPECT_TRUE(shows(View::PronatedOblique, 45, 0));
  EXPECT_FALSE(shows(View::PronatedOblique, -45, 0)) << "supinated";
  EXPECT_TRUE(shows(View::ProximalPole, 0, 30));
  EXPECT_FALSE(shows(View::ProximalPole, 90, 30));
  EXPECT_FALSE(shows(View::Pa, std::nan(""), 0));
}

}  // namespace
}  // namespace carpus::procedure
