// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/predicates.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace carpus::procedures::scaphoid_fixation {
namespace {

using instruments::instrument_of;
using procedure::LineFacts;
using procedure::Shot;

constexpr std::size_t kDrive = 3;
constexpr std::size_t kInsert = 7;

/// A situation that owns what it spans.
struct Scene {
  std::vector<LineFacts> lines;
  std::vector<Shot> shots;
  Situation now;

  const Situation& seen() {
    now.lines = lines;
    now.shots = shots;
    return now;
  }
  void shoot(double rotation_deg, double tilt_deg, std::uint32_t completed = 0) {
    shots.push_back({rotation_deg, tilt_deg, 0, completed, {}});
  }
};

LineFacts line(const char* instrument, double depth_mm, double buried_mm = -20) {
  LineFacts facts;
  facts.instrument = *instrument_of(instrument);
  facts.in_target = true;
  facts.depth_mm = depth_mm;
  facts.chord_mm = 25.0;
  facts.buried_mm = buried_mm;
  return facts;
}

TEST(Predicates, NothingIsDoneAtTheBeginning) {
  Scene scene;
  const Situation& now = scene.seen();
  EXPECT_FALSE(is_surveyed(now) || wire_touches_target(now) || is_wire_in_target(now) ||
               is_driven(now) || is_checked(now, kDrive) || is_measured(now) || is_reamed(now) ||
               is_screw_chosen(now) || is_screw_seated(now) || is_verified(now, kInsert));
  EXPECT_TRUE(has_no_line(now));
}

TEST(Predicates, ASurveyNeedsTwoViewsTwentyDegreesApart) {
  Scene scene;
  scene.shoot(0, 0);
  scene.shoot(15, 10);
  EXPECT_FALSE(is_surveyed(scene.seen()));
  scene.shoot(0, 20);
  EXPECT_TRUE(is_surveyed(scene.seen()));
}

TEST(Predicates, OnlyAWireOnTheScaphoidFindsTheEntry) {
  Scene scene;
  scene.now.hands[1] = {*instrument_of("probe"), 2, true};
  EXPECT_FALSE(wire_touches_target(scene.seen()));
  scene.now.hands[1] = {*instrument_of("guide_wire"), 3, false};
  EXPECT_FALSE(wire_touches_target(scene.seen())) << "on another bone";
  scene.now.hands[1].touches_target = true;
  EXPECT_TRUE(wire_touches_target(scene.seen()));
}

TEST(Predicates, AWireIsDrivenAtSixtyPercentOfItsLine) {
  Scene scene;
  scene.lines = {line("guide_wire", 14.9)};
  EXPECT_TRUE(is_wire_in_target(scene.seen()));
  EXPECT_FALSE(is_driven(scene.seen()));
  scene.lines = {line("guide_wire", 15.0)};
  EXPECT_TRUE(is_driven(scene.seen()));
  scene.lines.front().in_target = false;
  EXPECT_FALSE(is_driven(scene.seen()) || is_wire_in_target(scene.seen()));
  EXPECT_TRUE(has_no_line(scene.seen()));
}

TEST(Predicates, ViewsAreCheckedOnlySinceTheWireWasDriven) {
  Scene scene;
  scene.shoot(0, 0);
  scene.shoot(45, 0);
  EXPECT_FALSE(is_checked(scene.seen(), kDrive)) << "the wire is not in";
  scene.now.completed_steps = 1U << kDrive;
  scene.now.shots_at_completion[kDrive] = 2;
  scene.shoot(0, 0);
  scene.shoot(90, 0);
  EXPECT_FALSE(is_checked(scene.seen(), kDrive)) << "without the oblique";
  scene.shoot(45, 0);
  EXPECT_TRUE(is_checked(scene.seen(), kDrive));
}

TEST(Predicates, AGaugeReadsAWireThatLiesInTheBone) {
  Scene scene;
  scene.now.gauge_reading_mm = 25.0;
  EXPECT_FALSE(is_measured(scene.seen()));
  scene.lines = {line("guide_wire", 24)};
  EXPECT_TRUE(is_measured(scene.seen()));
}

TEST(Predicates, ReamingFollowsTheWiresLine) {
  Scene scene;
  scene.lines = {line("guide_wire", 24)};
  scene.now.reamed_mm = 14.0;
  EXPECT_FALSE(is_reamed(scene.seen()));
  scene.now.reamed_mm = 23.0;
  EXPECT_TRUE(is_reamed(scene.seen()));
}

TEST(Predicates, AScrewIsChosenInTheHandAndSeatedInTheBone) {
  Scene scene;
  scene.now.hands[0].instrument = *instrument_of("acutrak_2_mini_24");
  EXPECT_TRUE(is_screw_chosen(scene.seen()));
  EXPECT_FALSE(is_screw_seated(scene.seen()));
  scene.now.hands[0].instrument = instruments::kNoInstrument;
  scene.lines = {line("acutrak_2_mini_24", 23.9, -0.1)};
  EXPECT_TRUE(is_screw_chosen(scene.seen()));
  EXPECT_FALSE(is_screw_seated(scene.seen()));
  scene.lines.front().buried_mm = 0.0;
  EXPECT_TRUE(is_screw_seated(scene.seen()));
  EXPECT_FALSE(has_no_line(scene.seen())) << "the wire may be out by now";
}

TEST(Predicates, TheEndIsVerifiedByAShotOfTheSeatedScrew) {
  Scene scene;
  scene.lines = {line("acutrak_2_mini_24", 26, 2)};
  scene.shoot(0, 0);
  scene.now.is_finishing = true;
  EXPECT_FALSE(is_verified(scene.seen(), kInsert)) << "taken before it was in";
  scene.shoot(0, 0, 1U << kInsert);
  EXPECT_TRUE(is_verified(scene.seen(), kInsert));
  scene.now.is_finishing = false;
  EXPECT_FALSE(is_verified(scene.seen(), kInsert));
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
