// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/motion_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "instruments/instrument.hpp"

namespace carpus::cli {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

simulation::Snapshot with_scope_and_wire() {
  simulation::Snapshot now;
  now.items[3].instrument = instruments::instrument_of("guide_wire").value();
  now.items[3].tip_in_patient = {1.5, -2.25, 30};
  now.items[3].depth_mm = 4.5;
  now.items[5].instrument = instruments::instrument_of("arthroscope_2_7_30").value();
  now.hands[0].item = 5;
  now.hands[1].item = 3;
  now.hands[1].touching = true;
  now.hands[1].force_in_patient = {0, 3, 4};
  now.scope.hand = 0;
  now.scope.axis_in_patient = {0, 0.6, 0.8};
  now.scope.shaft_turn_deg = 90;
  now.scope.facts.points_seen = 0b1011;
  now.scope.facts.is_in_joint[0] = true;
  return now;
}

TEST(MotionTable, HasALineForEachHandThatHoldsSomething) {
  MotionTable table(20);
  simulation::Snapshot now = with_scope_and_wire();
  now.tick = 40;
  table.see(now);
  const auto lines = lines_of(table.text());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1],
            "0.040,0,arthroscope_2_7_30,0.0000,0.0000,0.0000,0.000000,0.000000,1.000000,0.0000,"
            "0.0000,0,1,0.000000,0.600000,0.800000,90.00,0.00,3");
  EXPECT_EQ(lines[2],
            "0.040,1,guide_wire,1.5000,-2.2500,30.0000,0.000000,0.000000,1.000000,4.5000,5.0000,"
            "1,0,,,,,,");
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','),
              std::count(lines[0].begin(), lines[0].end(), ','))
        << line;
  }
}

TEST(MotionTable, LeavesOutMomentsBetweenItsOwnAndEmptyHands) {
  MotionTable table(20);
  simulation::Snapshot now = with_scope_and_wire();
  now.tick = 41;
  table.see(now);
  now.tick = 60;
  now.hands[0].item = now.hands[1].item = simulation::kNoItem;
  table.see(now);
  EXPECT_EQ(lines_of(table.text()).size(), 1U);
}

}  // namespace
}  // namespace carpus::cli
