// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/section_picture.hpp"

#include <gtest/gtest.h>

namespace carpus::cli {
namespace {

using namespace soft_tissue;

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

TEST(SectionPicture, DrawsACurveWhereThereAreRestsAndNamesEachCut) {
  SectioningTable table;
  table.moment_nm = 2;
  table.cuts = {{"intact", "intact", {}}, {"sl", "SL", {"SL_"}}};
  table.directions = {{"radial_deviation", 0, 1}};
  SectioningResult result;
  for (const BenchCut& cut : table.cuts) {
    MomentCurve curve{"radial_deviation", {}, 0, 0};
    for (const double nm : {1.0, 2.0}) {
      RestingWrist w;
      w.moment_nm = nm;
      w.hand.radial_deviation_deg = 10 * nm;
      w.is_settled = cut.id == "intact" || nm < 1.5;
      curve.steps.push_back(w);
    }
    result.wrists.push_back({cut.id, {curve}, {}});
  }
  const std::string svg = section_picture(result, table);
  EXPECT_NE(svg.find("radial deviation"), std::string::npos);
  EXPECT_NE(svg.find("cut: SL"), std::string::npos);
  EXPECT_NE(svg.find("Simulated"), std::string::npos);
  EXPECT_EQ(count_of(svg, "<path"), 1u);  // of the cut one a single rest was found
  EXPECT_EQ(count_of(svg, "<svg"), 1u);
}

}  // namespace
}  // namespace carpus::cli
