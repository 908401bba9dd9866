// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/thesis_report.hpp"

#include <gtest/gtest.h>

namespace carpus::bench {
namespace {

const HullRow kHybrid{
    .set = "Scaphoid",
    .engine = "hybrid",
    .origin = {.source = "scaphoid.ply", .surface_facets = 5776, .thesis_points = 2890},
    .n = 2890,
    .h = 1182,
    .facets = 2360,
    .ran = true,
    .seconds = 0.0419};

HullRow taking(const char* engine, double seconds) {
  HullRow row = kHybrid;
  row.engine = engine;
  row.seconds = seconds;
  return row;
}

TEST(ThesisReport, PutsSizesSecondsAndRatiosBesideThoseOfTheThesis) {
  const std::vector<HullRow> rows{kHybrid, taking("chan", 0.0128), taking("quickhull", 0.00175),
                                  taking("gift_wrapping", 0.0429)};
  const std::string text = thesis_text(thesis_table_4_1(), rows);
  EXPECT_NE(text.find("5776   5784"), std::string::npos) << text;      // facets of the surface
  EXPECT_NE(text.find("12.80      1.03"), std::string::npos) << text;  // Chan's time
  EXPECT_NE(text.find("3.27    0.85"), std::string::npos) << text;     // hybrid / Chan
  EXPECT_NE(text.find("12.1"), std::string::npos) << text;  // 2539 of 2890 are left by stage 1
  EXPECT_NE(text.find("6 of 9 in this table"), std::string::npos) << text;
}

TEST(ThesisReport, AnEngineThatDidNotRunHasNoRatio) {
  HullRow chan = taking("chan", 0);
  chan.ran = false;
  const std::vector<HullRow> rows{kHybrid, chan};
  const std::vector<ThesisBeside> bones = beside_thesis(thesis_table_4_1(), rows);
  ASSERT_EQ(bones.size(), 9U);
  EXPECT_EQ(bones[6].hybrid, &rows[0]);
  EXPECT_FALSE(ratio_of(bones[6].hybrid, bones[6].chan));
  EXPECT_EQ(thesis_text(thesis_table_4_1(), rows).find("times Chan's time"), std::string::npos);
}

}  // namespace
}  // namespace carpus::bench
