// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/section_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace carpus::cli {
namespace {

using namespace soft_tissue;

struct Made {
  SectioningTable table;
  SectioningResult result;
};

Made made() {
  Made m;
  m.table.moment_nm = 2;
  m.table.press_n = 20;
  m.table.cuts = {{"intact", "intact", {}}, {"sl", "SL", {"SL_"}}};
  m.table.capsule = {{"dorsal", {}, 30, 2.0, ""}, {"volar", {}, 60, std::nullopt, "LRL"}};
  m.result.capsule_slack_mm = {2, 9.25};
  m.table.directions = {{"radial_deviation", 0, 1}};
  m.table.positions = {{"neutral", 0, 0}};
  for (const BenchCut& cut : m.table.cuts) {
    RestingWrist w;
    w.hand.radial_deviation_deg = cut.id == "sl" ? 21.5 : 20;
    w.scaphoid.flexion_deg = 12.5;
    w.is_settled = cut.id != "sl";
    m.result.wrists.push_back(
        {cut.id, {{"radial_deviation", {w}, w.hand.radial_deviation_deg, 0.25}}, {{"neutral", w}}});
  }
  PublishedStatement s;
  s.id = "range";
  s.kind = PublishedStatement::Kind::Range;
  s.cut = "intact";
  s.place = "radial_deviation";
  s.limits = {15, 35};
  s.published = "about 25 deg";
  s.mark = "[K]";
  m.table.published.push_back(s);
  s.id = "not_found";
  s.cut = "sl";
  m.table.published.push_back(s);
  s.id = "too_little";
  s.cut = "intact";
  s.limits = {30, 35};
  s.why_not = "because";
  m.table.published.push_back(s);
  m.result.rests = 4;
  m.result.unsettled = 2;
  return m;
}

TEST(SectionReport, TellsReachedFromNotReachedAndNotMeasured) {
  Made m = made();
  const std::string text = section_table(m.result, m.table);
  EXPECT_NE(text.find("   2.0  dorsal\n"), std::string::npos) << text;
  EXPECT_NE(text.find("9.2  volar: as the whole wrist's motion asks for"), std::string::npos)
      << text;
  EXPECT_NE(text.find("20.0 deg     reached       about 25 deg [K]"), std::string::npos) << text;
  EXPECT_NE(text.find("not reached   about 25 deg"), std::string::npos);
  EXPECT_NE(text.find("because"), std::string::npos);
  EXPECT_NE(text.find("not measured"), std::string::npos);
  EXPECT_NE(text.find("no rest found"), std::string::npos);
  EXPECT_NE(text.find("4 rests, 2 not found"), std::string::npos);
  m.table.published[0].is_fitted = true;
  EXPECT_NE(section_table(m.result, m.table).find("fitted"), std::string::npos);
}

TEST(SectionReport, WritesEveryFigureAsJson) {
  const Made m = made();
  const auto json = nlohmann::json::parse(section_json(m.result, m.table, "wrist", true));
  EXPECT_TRUE(json.at("case_simulated"));
  EXPECT_EQ(json.at("cuts").at(1).at("curves").at(0).at("range_deg"), 21.5);
  EXPECT_EQ(json.at("cuts").at(0).at("held").at(0).at("scaphoid").at("flexion_deg"), 12.5);
  EXPECT_EQ(json.at("capsule").at(1).at("slack_mm"), 9.25);
  EXPECT_EQ(json.at("published").at(0).at("verdict"), "reached");
  EXPECT_TRUE(json.at("published").at(1).at("ours").is_null());
  EXPECT_EQ(json.at("published").at(1).at("verdict"), "not measured");
  EXPECT_EQ(json.at("published").at(2).at("verdict"), "not reached");
}

}  // namespace
}  // namespace carpus::cli
