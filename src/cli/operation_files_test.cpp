// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/operation_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace carpus::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

cases::CaseData wrist(bool simulated) {
  cases::CaseData data;
  data.pseudonym = "demo wrist";
  data.provenance.simulated = simulated;
  return data;
}

TEST(OperationFiles, NameACaseWithWhetherItIsSimulated) {
  EXPECT_EQ(in_words(wrist(true)), "'demo wrist' (simulated)");
  EXPECT_EQ(in_words(wrist(false)), "'demo wrist'");
}

TEST(OperationFiles, ScoreInAFileSaysOfWhichCaseItIs) {
  for (const bool simulated : {true, false}) {
    const auto json = nlohmann::json::parse(score_file(wrist(simulated), {}));
    EXPECT_EQ(json["case"], "demo wrist");
    EXPECT_EQ(json["case_simulated"], simulated);
    EXPECT_EQ(json["score_version"], 2);
  }
}

TEST(ScoreTable, TellsTheLengthsInTheScaphoidAndEveryReason) {
  procedure::ScoreReport report;
  report.central_axis_length_mm = 25.12;
  report.longest_line_mm = 27.5;
  report.angle_to_longest_line_deg = 6.25;
  report.true_length_mm = 24.75;
  report.gauge_reading_mm = 24.0;
  procedure::ScoreItem item;
  item.label = "Angle to the central axis";
  item.reason = std::string(600, 'r') + " The end.";
  item.mark = "[S50]";
  report.items = {item};
  EXPECT_THAT(score_table(report),
              AllOf(HasSubstr("central axis: 25.12 mm\n"),
                    HasSubstr("longest line through the bone: 27.50 mm, angle to it: 6.25 deg\n"),
                    HasSubstr("true length along the wire: 24.75 mm, gauge reading: 24.00 mm\n"),
                    HasSubstr("\n    " + item.reason + "\n    Limits: [S50]\n")));
}

TEST(ScoreTable, SaysWhatWasNotMeasured) {
  procedure::ScoreReport report;
  report.central_axis_length_mm = 25.0;
  EXPECT_THAT(score_table(report),
              AllOf(HasSubstr("angle to it: not measured\n"),
                    HasSubstr("wire: not measured, gauge reading: not measured\n")));
  // No screw, no line: an arthroscopy.
  EXPECT_THAT(score_table({}), Not(HasSubstr("central axis")));
}

}  // namespace
}  // namespace carpus::cli
