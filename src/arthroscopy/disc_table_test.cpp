// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/disc_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace carpus::arthroscopy {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kGood = R"({
  "doc": "d", "schema_version": 1,
  "spacing_mm": {"value": 0.8, "mark": "[E]"},
  "along_n_per_mm": {"value": 16, "mark": "[E]"},
  "foundation_n_per_mm2": {"value": 0.25, "mark": "[E]"},
  "mass_g_per_mm2": {"value": 0.7, "mark": "[E]"},
  "damping_per_s": {"value": 60, "mark": "[E]"},
  "off_the_fovea": {"radius_mm": {"value": 3.2, "mark": "[E]"},
                    "left_share": {"value": 0.05, "mark": "[E]"}},
  "published": {"pressed_whole_mm": {"value": 0.6, "mark": "[S78]"},
                "pressed_off_mm": {"value": 0.9, "mark": "[S78]"},
                "rests_off_mm": {"value": 1.3, "mark": "[S78]"}}
})";

std::string refusal_with(std::string_view from, std::string_view to) {
  std::string text(kGood);
  text.replace(text.find(from), from.size(), to);
  try {
    (void)DiscTable::parse(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(DiscTable, IsReadFigureByFigure) {
  const DiscTable table = DiscTable::parse(kGood);
  EXPECT_EQ(table.spacing_mm, 0.8);
  EXPECT_EQ(table.material.along_n_per_mm, 16);
  EXPECT_EQ(table.material.mass_g_per_mm2, 0.7);
  EXPECT_EQ(table.off_left_share, 0.05);
  EXPECT_EQ(table.published.pressed_off_mm, 0.9);
  EXPECT_GT(DiscTable::generic().published.rests_off_mm, 0);
}

TEST(DiscTable, AFigureWithoutItsMarkAndWhatIsOutOfRangeAreRefusedByName) {
  EXPECT_THAT(refusal_with(R"({"value": 16, "mark": "[E]"})", R"({"value": 16})"),
              HasSubstr("along_n_per_mm"));
  EXPECT_THAT(refusal_with(R"("left_share": {"value": 0.05)", R"("left_share": {"value": 1.5)"),
              HasSubstr("left_share"));
  EXPECT_THAT(refusal_with(R"("rests_off_mm")", R"("rests_of_mm")"), HasSubstr("rests_off_mm"));
}

}  // namespace
}  // namespace carpus::arthroscopy
