// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/thesis_tables.hpp"

#include <gtest/gtest.h>

namespace carpus::bench {
namespace {

/// What a test says of a misprint.
struct Expected {
  std::string_view bone, engine;
  double printed, own;
};

void expect_misprints(std::span<const ThesisRow> table, std::vector<Expected> expected) {
  const std::vector<PrintedGain> misprints = misprinted_gains(table);
  ASSERT_EQ(misprints.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(misprints[i].bone, expected[i].bone);
    EXPECT_EQ(misprints[i].engine, expected[i].engine);
    EXPECT_EQ(misprints[i].percent, expected[i].printed);
    for (const ThesisRow& row : table) {
      if (row.name != expected[i].bone) continue;
      EXPECT_NEAR(gain_of(row, misprints[i].other), expected[i].own, 0.005);
    }
  }
}

TEST(ThesisTables, ThreePrintedGainsContradictTheirOwnTable) {
  expect_misprints(thesis_table_4_1(), {{"3rd Metacarpal", "quickhull", 42.85, 45.45},
                                        {"3rd Metacarpal", "chan", 13.33, 20.00}});
  expect_misprints(thesis_table_4_2(), {{"Femur", "quickhull", 21.92, 21.86}});
}

}  // namespace
}  // namespace carpus::bench
