// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/possible_counts.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

namespace carpus::simulation::detail {
namespace {

constexpr Tick kNow = 4000;
constexpr std::uint32_t kMore = kHands * kNow + 1;

cases::ArthroscopicMap map_of_two() {
  cases::ArthroscopicMap map;
  map.points.resize(2);
  map.points[0].number = 3;
  map.points[1].number = 7;
  return map;
}

/// `good` is possible; changed in any of these ways it is not.
template <typename State, typename IsPossible>
void expect_refused(
    const State& good,
    const IsPossible& is_possible,
    const std::vector<std::pair<const char*, std::function<void(State&)>>>& forgeries) {
  ASSERT_TRUE(is_possible(State{}, 1)) << "as it is at first";
  ASSERT_TRUE(is_possible(good, kNow));
  for (const auto& [what, change] : forgeries) {
    State bad = good;
    change(bad);
    EXPECT_FALSE(is_possible(bad, kNow)) << what;
  }
}

TEST(PossibleCounts, AScopeSawNothingForLongerThanThereWasTime) {
  const cases::ArthroscopicMap map = map_of_two();
  ScopeState good;
  good.in_view_ticks[1] = kNow;
  good.points_in_view = good.points_seen = 1U << 7U;
  good.points_probed = 1U << 3U;
  good.lesion_ticks[2] = kNow;
  good.lesions_seen = 0b100;
  good.entries = 2;
  good.pull_outs = 1;
  good.looking_ticks = kNow;
  good.tilted_ticks = kNow;
  good.warn_ticks = 50;
  good.injury_ticks = 50;
  good.look_count = 30;
  const auto is_possible = [&](const ScopeState& state, Tick now) {
    return are_counts_possible(state, now, map, 3);
  };
  expect_refused<ScopeState>(
      good, is_possible,
      {{"a place in view for longer", [](auto& s) { s.in_view_ticks[1] = kMore + 4; }},
       {"a place that there is not in view", [](auto& s) { s.in_view_ticks[2] = 1; }},
       {"a place that there is not seen", [](auto& s) { s.points_seen |= 1U; }},
       {"a place that there is not probed", [](auto& s) { s.points_probed |= 2U; }},
       {"a lesion in view for longer", [](auto& s) { s.lesion_ticks[2] = kMore + 6; }},
       {"a lesion that there is not in view", [](auto& s) { s.lesion_ticks[3] = 1; }},
       {"a lesion that there is not seen", [](auto& s) { s.lesions_seen |= 8U; }},
       {"in more often than ticks", [](auto& s) { s.entries = kMore; }},
       {"out as often as in", [](auto& s) { s.pull_outs = 2; }},
       {"looked for longer", [](auto& s) { s.looking_ticks = kMore; }},
       {"tilted for longer than it looked", [](auto& s) { ++s.tilted_ticks; }},
       {"pressed for longer", [](auto& s) { s.warn_ticks = kMore; }},
       {"hurt without pressing", [](auto& s) { ++s.injury_ticks; }},
       {"more looks than ticks of looking",
        [](auto& s) { s.looking_ticks = s.tilted_ticks = 29; }}});
  EXPECT_FALSE(is_possible(good, 400)) << "seen before there was a second";
}

TEST(PossibleCounts, ConductIsOfTicksThatPassed) {
  ScopeConduct good;
  good.scuffs = 2;
  good.places[0].tick = 10;
  good.places[1].tick = kNow;
  good.capsule_pushes = 3;
  good.smoothness[0].stretches = kNow / kMeanTicks;
  expect_refused<ScopeConduct>(
      good, [](const auto& s, Tick now) { return are_counts_possible(s, now); },
      {{"scuffed later than now", [](auto& s) { s.places[1].tick = kNow + 1; }},
       {"scuffed earlier than before", [](auto& s) { s.places[1].tick = 9; }},
       {"scuffs without time", [](auto& s) { s.scuffs = 2 * kMore; }},
       {"pushes without time", [](auto& s) { s.capsule_pushes = kMore; }},
       {"ways without time", [](auto& s) { s.smoothness[1].stretches = kMore / kMeanTicks + 1; }}});
}

TEST(PossibleCounts, ExercisesAreOfTicksThatPassed) {
  expect_refused<DrillState>(
      DrillState{}, [](const auto& s, Tick now) { return are_counts_possible(s, now); },
      {{"held for longer", [](auto& s) { s.hold_ticks = kMore; }},
       {"lost for longer", [](auto& s) { s.off_hold_ticks = kMore; }},
       {"off the line for longer", [](auto& s) { s.off_line_ticks = kMore; }},
       {"holds broken without time", [](auto& s) { s.done.hold_breaks = kMore; }},
       {"wrong touches without time", [](auto& s) { s.done.wrong_touches = kMore; }},
       {"lines broken without time", [](auto& s) { s.done.line_breaks = kMore; }}});
}

TEST(PossibleCounts, JawsCatchAndLoseAsOftenAsTheyClose) {
  LooseState good;
  good.done.closings = 3;
  good.done.unseen_closings = 3;
  good.done.catches = 2;
  good.done.bites = 1;
  good.done.slips = 2;
  good.done.out = 1;
  expect_refused<LooseState>(good,
                             [](const auto& s, Tick now) { return are_counts_possible(s, now); },
                             {{"closings without time", [](auto& s) { s.done.closings = kMore; }},
                              {"unseen ones of none", [](auto& s) { ++s.done.unseen_closings; }},
                              {"catches without closing", [](auto& s) { ++s.done.catches; }},
                              {"bites without closing", [](auto& s) { ++s.done.bites; }},
                              {"slips without closing", [](auto& s) { ++s.done.slips; }},
                              {"out, and never caught", [](auto& s) { s.done.catches = 0; }}});
}

TEST(PossibleCounts, AShaverRanNoLongerThanThereWasTime) {
  ShavingState good;
  good.done.patches = 2;
  good.done.patches_seen = 1;
  good.patch_ticks[1] = kNow;
  good.done.running_ticks = 100;
  good.done.cartilage_ticks = 60;
  good.done.lining_ticks = 40;
  good.done.scope_ticks = 100;
  good.done.way_ticks = kNow;
  good.done.ticks_since_cut = kNow;
  expect_refused<ShavingState>(
      good, [](const auto& s, Tick now) { return are_counts_possible(s, now); },
      {{"a patch in view for longer", [](auto& s) { s.patch_ticks[1] = kMore; }},
       {"a patch that there is not", [](auto& s) { s.patch_ticks[2] = 1; }},
       {"run for longer", [](auto& s) { s.done.running_ticks = kMore; }},
       {"harmed without running", [](auto& s) { ++s.done.lining_ticks; }},
       {"against the scope without running", [](auto& s) { ++s.done.scope_ticks; }},
       {"in the way for longer", [](auto& s) { s.done.way_ticks = kMore; }},
       {"since a cut before the beginning", [](auto& s) { s.done.ticks_since_cut = kNow + 1; }}});
  EXPECT_FALSE(are_counts_possible(good, 500)) << "seen before there was a second";
}

TEST(PossibleCounts, BitesAndFluidAreOfTicksThatPassed) {
  expect_refused<PunchState>(PunchState{},
                             [](const auto& s, Tick now) { return are_counts_possible(s, now); },
                             {{"bites without time", [](auto& s) { s.done.bites = kMore; }}});
  JointFluid good;
  good.facts.over_limit_ticks = good.facts.watched_ticks = kNow;
  expect_refused<JointFluid>(good,
                             [](const auto& s, Tick now) { return are_counts_possible(s, now); },
                             {{"too high for longer", [](auto& s) { ++s.facts.over_limit_ticks; }},
                              {"watched for longer", [](auto& s) { ++s.facts.watched_ticks; }}});
}

TEST(PossibleCounts, PortalsWereMadeInTicksThatPassed) {
  MakingState good;
  good.facts.portal[1].needle_seen_ticks = kNow;
  good.worked.hands[1].seen_ticks = kNow;
  good.worked.hands[0].ticks = kNow;
  expect_refused<MakingState>(
      good, [](const auto& s, Tick now) { return are_counts_possible(s, now); },
      {{"a needle seen for longer", [](auto& s) { ++s.facts.portal[1].needle_seen_ticks; }},
       {"seen now for longer", [](auto& s) { ++s.worked.hands[1].seen_ticks; }},
       {"in the joint for longer", [](auto& s) { ++s.worked.hands[0].ticks; }},
       {"felt for longer", [](auto& s) { s.felt[0].ticks = kMore; }},
       {"passes without time", [](auto& s) { s.facts.portal[0].passes = kMore; }},
       {"strikes without time", [](auto& s) { s.facts.portal[0].bone_strikes = kMore; }}});
  good = {};
  good.facts.portal[0].cuts = 9;
  EXPECT_FALSE(are_counts_possible(good, 4)) << "more cuts than hands had time for";
}

}  // namespace
}  // namespace carpus::simulation::detail
