// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/grading.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/error.hpp"
#include "procedure/detail/read_score_rules.hpp"

namespace carpus::procedure {
namespace {

constexpr std::string_view kRules = R"({
  "safety": [
    {"id": "cover", "label": "Covered", "measure": "cover_mm", "within": [0.5, null], "mark": "[E]"},
    {"id": "joystick", "label": "No joystick", "measure": "joysticks", "within": [null, 0], "mark": "[E]"}
  ],
  "score": [
    {"id": "cover_mm", "label": "Cover", "unit": "mm", "good": [1.25, 2.75], "fail": [0.5, 6], "weight": 6,
     "why": "Why.", "mark": "[K]"},
    {"id": "time_s", "label": "Time", "unit": "s", "good": [null, 600], "fail": [null, 1800], "weight": 2,
     "why": "Why.", "mark": "[E]"},
    {"id": "angle_deg", "label": "Angle", "unit": "deg", "good": [null, 5], "fail": [null, 15], "weight": 0,
     "why": "Why.", "mark": "[E]"}
  ]
})";

ScoreRules read(std::string_view text) {
  const nlohmann::json json = parse_json_text(text, "test.json");
  JsonFields fields(json, "test.json", "");
  return detail::read_score_rules(fields);
}

std::array<Measure, 4> measures(double cover_mm, double time_s) {
  return {Measure{"cover_mm", cover_mm, "Seen."}, Measure{"time_s", time_s, ""},
          Measure{"angle_deg", 20.0, ""}, Measure{"joysticks", std::nullopt, "", false}};
}

double overall(double cover_mm, double time_s) {
  ScoreReport report;
  grade(report, read(kRules), measures(cover_mm, time_s));
  return report.overall;
}

TEST(Grading, PointsFallLinearlyBetweenGoodAndFail) {
  EXPECT_EQ(overall(2.0, 60), 100.0);
  EXPECT_NEAR(overall(0.875, 60), 100 * (3 + 2) / 8.0, 1e-9);
  EXPECT_NEAR(overall(4.375, 60), 100 * (3 + 2) / 8.0, 1e-9);
  EXPECT_NEAR(overall(2.0, 1200), 100 * (6 + 1) / 8.0, 1e-9);
  EXPECT_NEAR(overall(7.0, 3000), 0.0, 1e-9);
}

TEST(Grading, EachItemSaysWhereItsLimitsComeFrom) {
  ScoreReport report;
  grade(report, read(kRules), measures(2.0, 60));
  EXPECT_EQ(report.items.at(0).mark, "[K]");
  EXPECT_EQ(report.items.at(1).mark, "[E]");
}

TEST(Grading, NothingEarnsPointsWithoutSafety) {
  ScoreReport report;
  grade(report, read(kRules), measures(0.4, 60));
  EXPECT_FALSE(report.is_fixation_acceptable);
  EXPECT_EQ(report.overall, 0.0);
  for (const ScoreItem& item : report.items) EXPECT_EQ(item.points, 0.0) << item.id;
  EXPECT_EQ(report.items[1].grade, Grade::Good) << "what was good is told all the same";
}

TEST(Grading, WhatNothingWasMeasuredOfIsToldApartAndFulfilsNothing) {
  ScoreReport report;
  std::array<Measure, 4> unmeasured = measures(2.0, 60);
  unmeasured[0].value.reset();
  grade(report, read(kRules), unmeasured);
  ASSERT_EQ(report.must_haves.size(), 1U);
  EXPECT_TRUE(report.must_haves[0].not_measured);
  EXPECT_FALSE(report.must_haves[0].fulfilled);
  EXPECT_FALSE(report.is_fixation_acceptable);
  grade(report, read(kRules), measures(0.4, 60));
  EXPECT_FALSE(report.must_haves[0].not_measured) << "too little is measured, and broken";
}

TEST(Grading, WhatACaseDoesNotHaveIsLeftOut) {
  ScoreReport report;
  grade(report, read(kRules), measures(2.0, 60));
  ASSERT_EQ(report.must_haves.size(), 1U);
  EXPECT_TRUE(report.is_fixation_acceptable);
}

TEST(Grading, AMeasureOfWeightZeroIsToldAndNotCounted) {
  ScoreReport report;
  grade(report, read(kRules), measures(2.0, 60));
  EXPECT_EQ(report.items[2].grade, Grade::Fail);
  EXPECT_EQ(report.items[2].points_possible, 0.0);
  EXPECT_EQ(report.overall, 100.0);
}

TEST(Grading, TargetsAreWords) {
  const ScoreRules rules = read(kRules);
  EXPECT_EQ(target_text(rules.items[0]), "1.25 to 2.75 mm good; under 0.5 mm or over 6 mm fails");
  EXPECT_EQ(target_text(rules.items[1]), "at most 10 min good, over 30 min fails");
  EXPECT_EQ(target_text(rules.items[2]), "at most 5° good, over 15° fails");
  ScoreRule count = rules.items[2];
  count.unit = "1";
  count.good.high = count.fail.high = 0;
  EXPECT_EQ(target_text(count), "none; a single one fails");
  count.fail.high = 2;
  EXPECT_EQ(target_text(count), "none is good, over 2 fails");
}

TEST(Grading, MistakesAreToldByPlaceAndField) {
  const auto error_of = [](std::string_view text) -> std::string {
    try {
      (void)read(text);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(
      error_of(R"({"safety": [], "score": [{"id": "a", "label": "A", "unit": "mm", "good": [1, 3],
      "fail": [2, 4], "weight": 1, "why": "w", "mark": "m"}]})")
          .find("fail lies inside good"),
      std::string::npos);
  EXPECT_NE(
      error_of(R"({"safety": [{"id": "a", "label": "A", "measure": "m", "within": [null, null],
      "mark": "m"}], "score": []})")
          .find("safety[0]: within"),
      std::string::npos);
  ScoreReport report;
  EXPECT_THROW(grade(report, read(kRules), std::array{Measure{"cover_mm", 1.0, ""}}), InvalidInput);
}

}  // namespace
}  // namespace carpus::procedure
