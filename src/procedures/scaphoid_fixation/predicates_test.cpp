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

constexpr double kChordMm = 25.0;

/// A situation that owns what it spans; all its shots are recent.
struct Scene {
  std::vector<LineFacts> lines;
  std::vector<Shot> shots;
  Situation now;

  Scene() { now.aim = {0, {1, 2, 3}, {0, 0, 1}, 27.0, 4.0}; }
  const Situation& seen() {
    now.lines = lines;
    now.shots = shots;
    now.recent_shots = shots;
    return now;
  }
  Shot& shoot(double rotation_deg, double tilt_deg) {
    Shot shot;
    shot.rotation_deg = rotation_deg;
    shot.tilt_deg = tilt_deg;
    for (const LineFacts& line : lines) {
      const bool is_screw = line.buried_mm > -20;
      shot.shows_screw = shot.shows_screw || is_screw;
      shot.shows_wire = shot.shows_wire || !is_screw;
    }
    return shots.emplace_back(shot);
  }
};

LineFacts line(const char* instrument, double depth_mm, double buried_mm = -20) {
  LineFacts facts;
  facts.instrument = *instrument_of(instrument);
  facts.in_target = true;
  facts.entry_in_bone = {1, 2, 3};
  facts.depth_mm = depth_mm;
  facts.chord_mm = kChordMm;
  facts.buried_mm = buried_mm;
  return facts;
}

TEST(Predicates, NothingIsDoneAtTheBeginning) {
  Scene scene;
  for (const auto& [name, predicate] : named_predicates()) {
    if (name.starts_with("is_") && name != "is_screw_unseated") {
      EXPECT_FALSE(predicate(scene.seen())) << name;
    }
  }
  EXPECT_TRUE(has_no_line(scene.seen()));
}

TEST(Predicates, ASurveyNeedsPaAndLateral) {
  Scene scene;
  scene.shoot(0, 0);
  scene.shoot(45, 0);
  EXPECT_FALSE(is_surveyed(scene.seen()));
  scene.shoot(-85, 5);
  EXPECT_FALSE(is_surveyed(scene.seen())) << "it was not said how the fracture lies";
  scene.now.judgement = procedure::Judgement::Displaced;
  EXPECT_TRUE(is_surveyed(scene.seen())) << "rightly or not: that is told afterwards";
}

TEST(Predicates, AWireIsDrawnThroughUntilItIsLevelAndSeenOnAStraightWrist) {
  Scene scene;
  scene.lines = {line("guide_wire", 60)};
  scene.lines[0].near_end_out_mm = 90;
  EXPECT_FALSE(is_flush(scene.seen()));
  scene.lines[0].near_end_out_mm = -6;
  EXPECT_FALSE(is_flush(scene.seen())) << "lost in the bone";
  scene.lines[0].near_end_out_mm = -1;
  EXPECT_TRUE(is_flush(scene.seen()));
  scene.shoot(0, 0).wrist.flexion_rad = 0.7;
  scene.shoot(90, 0).wrist.flexion_rad = 0.7;
  EXPECT_FALSE(is_seen_extended(scene.seen())) << "flexed still";
  scene.shoot(0, 0).wrist.flexion_rad = 0.1;
  EXPECT_FALSE(is_seen_extended(scene.seen()));
  scene.shoot(90, 0).wrist.flexion_rad = -0.2;
  EXPECT_TRUE(is_seen_extended(scene.seen()));
}

TEST(Predicates, AWireIsDrivenBackOnceItStandsOutAgainAndItsTipIsUnderTheCortex) {
  Scene scene;
  scene.lines = {line("guide_wire", kChordMm - 1)};
  scene.lines[0].near_end_out_mm = 120;
  EXPECT_FALSE(is_driven_back(scene.seen())) << "it was never drawn through";
  scene.lines[0].was_flush = true;
  EXPECT_TRUE(is_driven_back(scene.seen()));
  scene.lines[0].depth_mm = kChordMm + 5;
  EXPECT_FALSE(is_driven_back(scene.seen()));
  scene.lines[0].depth_mm = kChordMm - 1;
  scene.lines[0].near_end_out_mm = 5;
  EXPECT_FALSE(is_driven_back(scene.seen())) << "nothing to work over";
}

TEST(Predicates, AWholeBoneIsReducedOnceSurveyedAPieceOnceItLiesRightAndWasSeenSo) {
  Scene scene;
  scene.shoot(0, 0);
  scene.shoot(90, 0);
  EXPECT_FALSE(is_reduced(scene.seen())) << "nothing was said of it";
  scene.now.judgement = procedure::Judgement::Aligned;
  EXPECT_TRUE(is_reduced(scene.seen()));
  scene.now.fracture = {true, 1.8, 2.4, 0.99};
  EXPECT_FALSE(is_reduced(scene.seen()));
  EXPECT_TRUE(is_displaced(scene.seen()));
  scene.now.fracture = {true, 0.5, 0.6, 0.90};
  EXPECT_FALSE(is_reduced(scene.seen())) << "flexed by 26 degrees";
  scene.now.fracture = {true, 0.5, 0.6, 0.99};
  EXPECT_TRUE(is_reduced(scene.seen()));
  scene.shots.pop_back();
  EXPECT_FALSE(is_reduced(scene.seen())) << "not seen in lateral since";
}

TEST(Predicates, TheRingIsSeenDownTheBoneAlone) {
  Scene scene;
  scene.shoot(0, 0).along_aim = 0.97;
  EXPECT_FALSE(is_ring_seen(scene.seen()));
  scene.shoot(20, 10).along_aim = 0.985;
  EXPECT_TRUE(is_ring_seen(scene.seen()));
}

TEST(Predicates, AnEntryIsRightWhereTheAimGoesIn) {
  Scene scene;
  scene.now.hands[0] = {*instrument_of("guide_wire"), 3, true};
  EXPECT_FALSE(is_entry_right(scene.seen())) << "touching is not entering";
  scene.lines = {line("guide_wire", 1)};
  EXPECT_TRUE(is_entry_right(scene.seen()));
  scene.lines.front().from_aim_mm = 4.5;
  EXPECT_FALSE(is_entry_right(scene.seen())) << "beside it";
  scene.lines = {line("acutrak_2_mini_24", 1)};
  EXPECT_FALSE(is_entry_right(scene.seen())) << "a screw finds no entry";
}

TEST(Predicates, ALineIsGoodWhenItRunsTheLengthOfTheBone) {
  Scene scene;
  scene.lines = {line("guide_wire", 3.9)};
  EXPECT_FALSE(is_line_long(scene.seen())) << "not committed yet";
  scene.lines = {line("guide_wire", 4.0)};
  EXPECT_TRUE(is_line_long(scene.seen()));
  scene.lines.front().chord_mm = 20.0;
  EXPECT_FALSE(is_line_long(scene.seen())) << "it leaves the bone at its side";
}

TEST(Predicates, AWireIsDrivenWhenItsTipLiesUnderTheFarCortex) {
  Scene scene;
  for (const auto& [depth, is_right] :
       {std::pair{15.0, false}, {22.4, false}, {22.6, true}, {25.2, true}, {25.5, false}}) {
    scene.lines = {line("guide_wire", depth)};
    EXPECT_EQ(is_driven(scene.seen()), is_right) << depth;
  }
}

TEST(Predicates, ViewsAreCheckedWithTheWireInPlace) {
  Scene scene;
  scene.shoot(0, 0);
  scene.shoot(90, 0);
  scene.shoot(45, 0);
  scene.lines = {line("guide_wire", 24)};
  EXPECT_FALSE(is_checked(scene.seen())) << "taken before it was in";
  scene.shoot(0, 0);
  scene.shoot(90, 0);
  EXPECT_FALSE(is_checked(scene.seen())) << "without the oblique";
  scene.shoot(45, 0);
  EXPECT_TRUE(is_checked(scene.seen()));
  scene.lines = {line("guide_wire", 34)};
  EXPECT_FALSE(is_checked(scene.seen())) << "it was driven on";
}

TEST(Predicates, AMeasureIsRightWhenTheWireEndsAtTheFarCortex) {
  Scene scene;
  scene.now.gauge_reading_mm = 25.0;
  EXPECT_FALSE(is_measured(scene.seen()));
  scene.lines = {line("guide_wire", 24)};
  EXPECT_TRUE(is_measured(scene.seen()));
  scene.now.gauge_reading_mm = 34.0;
  EXPECT_FALSE(is_measured(scene.seen())) << "the wire was nine millimetres out";
}

TEST(Predicates, ADrillStopsBeforeTheFarCortex) {
  Scene scene;
  scene.lines = {line("guide_wire", 24)};
  for (const auto& [reamed, is_right] :
       {std::pair{0.0, false}, {14.0, false}, {21.5, true}, {23.0, true}, {25.0, false}}) {
    scene.now.reamed_mm = reamed;
    EXPECT_EQ(is_reamed(scene.seen()), is_right) << reamed;
  }
}

TEST(Predicates, AScrewIsChosenByWhatWasMeasured) {
  Scene scene;
  scene.now.hands[0].instrument = *instrument_of("acutrak_2_mini_20");
  EXPECT_FALSE(is_screw_chosen(scene.seen())) << "nothing was measured";
  scene.now.gauge_reading_mm = 24.5;
  EXPECT_TRUE(is_screw_chosen(scene.seen()));
  scene.now.gauge_reading_mm = 23.5;
  EXPECT_FALSE(is_screw_chosen(scene.seen())) << "too long by half a millimetre";
  scene.now.gauge_reading_mm = 28.0;
  EXPECT_FALSE(is_screw_chosen(scene.seen())) << "too short";
}

TEST(Predicates, AScrewIsSeatedWhenBothEndsAreCovered) {
  Scene scene;
  for (const auto& [depth, buried, is_right] :
       {std::tuple{20.5, 0.5, false}, {21.5, 1.5, true}, {24.6, 2.0, false}, {24.2, 4.5, false}}) {
    scene.lines = {line("acutrak_2_mini_20", depth, buried)};
    EXPECT_EQ(is_screw_seated(scene.seen()), is_right) << depth << " " << buried;
  }
}

TEST(Predicates, TheWireComesOutAndAllViewsAreTakenOfTheScrew) {
  Scene scene;
  scene.lines = {line("acutrak_2_mini_20", 22, 2), line("guide_wire", 24)};
  EXPECT_FALSE(is_wire_out(scene.seen()));
  scene.lines.pop_back();
  EXPECT_TRUE(is_wire_out(scene.seen()));
  for (const auto& [rotation, tilt] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {45.0, 0.0}}) {
    scene.shoot(rotation, tilt);
  }
  EXPECT_FALSE(is_verified(scene.seen())) << "the proximal pole was not looked at";
  scene.shoot(0, -60);
  EXPECT_TRUE(is_verified(scene.seen()));
  scene.lines.front().buried_mm = 0.2;
  EXPECT_FALSE(is_verified(scene.seen())) << "it was turned back since";
}

TEST(Predicates, AWireIsHeldWhenItStandsOutAtBothEndsOnceItIsMeasured) {
  Scene scene;
  scene.lines = {line("guide_wire", 70)};
  scene.lines[0].near_end_out_mm = 80;
  scene.lines[0].far_end_is_out = true;
  EXPECT_FALSE(is_held_at_both_ends(scene.seen())) << "on its way through, before it was measured";
  scene.now.gauge_reading_mm = 25.0;
  EXPECT_TRUE(is_held_at_both_ends(scene.seen()));
  scene.lines[0].near_end_out_mm = 4;
  EXPECT_FALSE(is_held_at_both_ends(scene.seen()));
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
