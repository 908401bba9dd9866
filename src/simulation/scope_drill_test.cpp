// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/scope_drill.hpp"

#include <gtest/gtest.h>

namespace carpus::simulation::detail {
namespace {

procedure::ScopeDrill drill() {
  procedure::ScopeDrill made;
  made.hold = {2, 7};
  made.hold_s = 3;
  made.middle_deg = 13;
  made.still_mm = 2;
  made.round_places = 3;
  made.round_turn_deg = 180;
  made.touch = {8, 11, 16, 11, 8};
  made.touch_mm = 2.5;
  made.line = {8, 11, 16};
  made.line_mm = 3;
  return made;
}

/// 8, 11 and 16 in a row, 6 mm apart.
DrillGround ground() {
  const Vec3 a{0, 0, 0};
  const Vec3 b{6, 0, 0};
  const Vec3 c{12, 0, 0};
  return {{a, b, c, b, a}, {a, b, c}};
}

DrillLook centred() { return {{0, 0, 0}, true, true, 0, 0}; }

void look(DrillState& state, const DrillLook& at, int ticks) {
  for (int i = 0; i < ticks; ++i) watch_look(state, drill(), at);
}

/// @param at_mm  along the row
void lead(DrillState& state, double at_mm, bool touches, int ticks, double aside_mm = 0) {
  for (int i = 0; i < ticks; ++i) {
    watch_probe(state, drill(), ground(), {{at_mm, aside_mm, 0}, touches});
  }
}

void touch(DrillState& state, double at_mm) {
  lead(state, at_mm, true, 20);
  lead(state, at_mm, false, 20);
}

DrillState touched_all() {
  DrillState state;
  state.is_probe_seen = true;
  for (const double at : {0.0, 6.0, 12.0, 6.0, 0.0}) touch(state, at);
  return state;
}

TEST(ScopeDrill, APlaceIsHeldOnceItWasKeptForAsLongAsAsked) {
  DrillState state;
  look(state, centred(), 2999);
  EXPECT_EQ(state.done.held, 0);
  look(state, centred(), 1);
  EXPECT_EQ(state.done.held, 1);
  EXPECT_EQ(state.done.hold_breaks, 0U);
}

TEST(ScopeDrill, ABreakBeginsAnewAndIsCountedOnceItHadBegun) {
  for (const bool tilts : {true, false}) {
    DrillState state;
    look(state, centred(), 2000);
    DrillLook lost = centred();
    (tilts ? lost.is_level : lost.has_in_middle) = false;
    look(state, lost, 100);
    EXPECT_EQ(state.done.hold_breaks, 0U) << "a moment is forgiven";
    EXPECT_EQ(state.hold_ticks, 2000U) << "and does not count";
    look(state, lost, 150);
    EXPECT_EQ(state.done.hold_breaks, 1U);
    look(state, centred(), 2999);
    EXPECT_EQ(state.done.held, 0);
  }
  DrillState swept;
  look(swept, centred(), 100);
  lose_look(swept);
  EXPECT_EQ(swept.done.hold_breaks, 0U) << "swept over, not held";
}

TEST(ScopeDrill, ATipThatWandersHoldsNothing) {
  DrillState state;
  DrillLook at = centred();
  for (int i = 0; i < 6000; ++i) {
    at.tip.x = i * 0.001;  // 1 mm a second: 3 mm in three
    watch_look(state, drill(), at);
  }
  EXPECT_EQ(state.done.held, 0);
  EXPECT_GT(state.done.hold_breaks, 1U);
}

TEST(ScopeDrill, LookingRoundIsByTurningFromOnePlace) {
  const auto go_round = [](double step_mm, double step_deg) {
    DrillState state;
    DrillLook at = centred();
    for (int i = 0; i < 4; ++i) {
      at.tip.x += step_mm;
      at.shaft_turn_deg += step_deg;
      at.places_in_view = 1U << (i + 1);
      look(state, at, 10);
    }
    return state.done;
  };
  EXPECT_TRUE(go_round(0.2, 65).is_round_done);
  EXPECT_FALSE(go_round(3.0, 65).is_round_done) << "moved on";
  EXPECT_EQ(go_round(3.0, 65).round_most, 1);
  EXPECT_FALSE(go_round(0.2, 20).is_round_done) << "not turned";
  EXPECT_EQ(go_round(0.2, 20).round_most, 4);
}

TEST(ScopeDrill, ATurnAcrossTheSeamIsSmall) {
  DrillState state;
  DrillLook at = centred();
  at.shaft_turn_deg = 178;
  look(state, at, 1);
  state.round_turn_deg = 0;
  at.shaft_turn_deg = -178;
  look(state, at, 1);
  EXPECT_DOUBLE_EQ(state.round_turn_deg, 4);
}

TEST(ScopeDrill, TouchesCountInOrderWhileTheyAreSeen) {
  const DrillState state = touched_all();
  EXPECT_EQ(state.done.touched, 5);
  EXPECT_TRUE(state.done.are_touches_done);
  EXPECT_EQ(state.done.wrong_touches, 0U);

  DrillState blind;
  touch(blind, 0.0);
  EXPECT_EQ(blind.done.touched, 0) << "the scope does not see it";
  DrillState above;
  above.is_probe_seen = true;
  lead(above, 0.0, false, 100);
  EXPECT_EQ(above.done.touched, 0) << "over it, not on it";
}

TEST(ScopeDrill, APlaceOutOfTurnIsWrongOnce) {
  DrillState state;
  state.is_probe_seen = true;
  touch(state, 12.0);
  EXPECT_EQ(state.done.wrong_touches, 0U) << "before the first: looking for it";
  touch(state, 0.0);
  touch(state, 12.0);
  EXPECT_EQ(state.done.wrong_touches, 1U);
  touch(state, 0.0);
  EXPECT_EQ(state.done.wrong_touches, 1U) << "the last one again";
  touch(state, 6.0);
  EXPECT_EQ(state.done.touched, 2);
}

TEST(ScopeDrill, ALineIsFollowedAtAStretch) {
  DrillState state = touched_all();
  for (double at = 0; at <= 12; at += 0.1) lead(state, at, true, 5);
  EXPECT_TRUE(state.done.is_line_done);
  EXPECT_DOUBLE_EQ(state.done.line_share, 1.0);
  EXPECT_EQ(state.done.line_breaks, 0U);
}

TEST(ScopeDrill, LiftedItIsLostAndBeginsAgain) {
  DrillState state = touched_all();
  for (double at = 0; at <= 9; at += 0.1) lead(state, at, true, 5);
  lead(state, 9, false, 400);
  EXPECT_GT(state.line_share, 0.7) << "a moment is forgiven";
  lead(state, 9, false, 200);
  EXPECT_DOUBLE_EQ(state.line_share, 0.0);
  EXPECT_NEAR(state.done.line_share, 0.75, 0.01) << "the most stays";
  EXPECT_EQ(state.done.line_breaks, 1U);
  for (double at = 9; at <= 12; at += 0.1) lead(state, at, true, 5);
  EXPECT_FALSE(state.done.is_line_done) << "its end alone is no line";
}

TEST(ScopeDrill, WhatIsLeapedOverLedAsideOrLedUnseenIsNotFollowed) {
  DrillState leaps = touched_all();
  for (double at = 0; at <= 12; at += 3.0) lead(leaps, at, true, 600);
  EXPECT_FALSE(leaps.done.is_line_done);
  DrillState aside = touched_all();
  for (double at = 0; at <= 12; at += 0.1) lead(aside, at, true, 5, 4.0);
  EXPECT_DOUBLE_EQ(aside.done.line_share, 0.0);
  DrillState unseen = touched_all();
  for (double at = 0; at <= 6; at += 0.1) lead(unseen, at, true, 5);
  unseen.is_probe_seen = false;
  lead(unseen, 6, true, 5000);
  EXPECT_NEAR(unseen.line_share, 0.5, 0.01) << "it rests while the scope comes after it";
  for (double at = 6; at <= 12; at += 0.1) lead(unseen, at, true, 10);
  EXPECT_FALSE(unseen.done.is_line_done);
}

TEST(ScopeDrill, TheWayOfTheProbeIsTheScopesToSee) {
  DrillState state;
  lead(state, 0, false, 1);
  lead(state, 4, false, 1);
  state.is_probe_seen = true;
  lead(state, 5, false, 1);
  EXPECT_DOUBLE_EQ(state.done.unseen_path_mm, 4);
  EXPECT_DOUBLE_EQ(state.done.seen_path_mm, 1);
  lose_probe(state);
  lead(state, 50, false, 1);
  EXPECT_DOUBLE_EQ(state.done.unseen_path_mm, 4) << "outside is no way in the joint";
}

TEST(ScopeDrill, ImpossibleStatesAreToldApart) {
  EXPECT_TRUE(is_possible(touched_all(), drill()));
  DrillState state;
  state.done.held = 3;
  EXPECT_FALSE(is_possible(state, drill()));
  state = {};
  state.done.line_share = 1.5;
  EXPECT_FALSE(is_possible(state, drill()));
}

}  // namespace
}  // namespace carpus::simulation::detail
