// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/study_views_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace carpus::cli {
namespace {

using ::testing::HasSubstr;

/// Two screws out at the distal end, of which lateral reveals one, and one in.
ViewsStudy small_study() {
  const std::size_t count = view_trainer::standard_views().size();
  view_trainer::StudiedCase each;
  each.pseudonym = "a wrist";
  each.reading_errors.resize(count);
  for (const auto region : {view_trainer::Region::Distal, view_trainer::Region::Proximal}) {
    each.first_revealed.push_back({region, std::vector<std::optional<double>>(count + 1)});
  }
  each.first_revealed[1].depth_mm.back() = 1.25;
  view_trainer::StudiedScrew screw;
  screw.truth = {1.5, {}, view_trainer::Region::Distal};
  screw.overhangs.resize(count);
  each.screws.push_back(screw);
  screw.overhangs[view_trainer::view_index("lateral")] = {0.9, 0.8};
  each.screws.push_back(screw);
  screw.truth.depth_mm = -1.0;
  screw.overhangs.assign(count, {});
  each.screws.push_back(screw);
  return {1, 3, {true}, {each}};
}

TEST(ViewsStudyReport, JsonHasRowsOfTheStatedForm) {
  const auto json = nlohmann::json::parse(views_study_json(small_study()));
  EXPECT_EQ(json["revealed_mm"], 0.5);
  bool has_pair = false;
  for (const auto& row : json["rows"]) {
    EXPECT_EQ(row.size(), 4U);
    EXPECT_EQ(row["screws"], 3);
    has_pair |= row["views"] == nlohmann::json({"pa", "lateral"}) && row["sensitivity"] == 0.5 &&
                row["specificity"] == 1.0;
  }
  EXPECT_TRUE(has_pair);
  EXPECT_EQ(json["rows"].size(), json["rows_true_outline"].size());
  EXPECT_TRUE(json["by_region"][1]["rows"][0]["sensitivity"].is_null());
  EXPECT_EQ(json["cases"][0]["screws_out"], 2);
  EXPECT_EQ(json["first_revealed"].back()["mean_mm"], 1.25);
}

TEST(ViewsStudyReport, TextSetsThePublishedFindingBesideOurs) {
  const std::string text = views_study_text(small_study());
  EXPECT_THAT(text, HasSubstr("in silico"));
  EXPECT_THAT(text, HasSubstr("about 50 % [S40]; ours 50 %"));
  EXPECT_THAT(text, HasSubstr("1.2 mm (1/1)"));
}

TEST(ViewsStudyReport, PictureHasALineForEverySetOfViews) {
  const std::string svg = views_study_picture(small_study());
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("skyline"));
  EXPECT_THAT(svg, HasSubstr("PA + LAT + 45P"));
}

}  // namespace
}  // namespace carpus::cli
