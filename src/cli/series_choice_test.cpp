// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/series_choice.hpp"

#include <gtest/gtest.h>

namespace carpus::cli {
namespace {

TEST(SeriesChoice, GoesFromOneProcessToTheOther) {
  const auto offers = parse_series_choice(
      series_choice_text({{"1.2.3", "Wrist \xff\x1b[31m", "CT", 200, "/scan", {0.3, 0.3, 0.5}},
                          {"1.2.4", "", "CT", 90, "/scan", {}}}));
  ASSERT_EQ(offers.size(), 2U);
  EXPECT_EQ(offers[0].uid, "1.2.3");
  EXPECT_EQ(offers[0].description, "Wrist ??[31m");
  EXPECT_EQ(offers[0].slices, 200);
  EXPECT_EQ(offers[0].spacing_mm, (std::array<double, 3>{0.3, 0.3, 0.5}));
  EXPECT_EQ(offers[1].description, "");
}

TEST(SeriesChoice, IsEmptyWhereItIsNoList) {
  for (const char* text :
       {"", "{", "[]", R"({"series":1})", R"({"series":[{}]})",
        R"({"series":[{"uid":1,"description":"","slices":1,"spacing_mm":[1]}]})"}) {
    EXPECT_TRUE(parse_series_choice(text).empty()) << text;
  }
}

}  // namespace
}  // namespace carpus::cli
