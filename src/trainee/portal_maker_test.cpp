// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Scripted hands make portals through a plate of skin over the box of a joint.
#include "trainee/portal_maker.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "simulation/skin_over_box_test_support.hpp"

namespace carpus::trainee {
namespace {

using namespace simulation::box_joint;  // NOLINT(google-build-using-namespace)

constexpr Tick kLongest = 240'000;

simulation::Snapshot operate(Skill skill,
                             std::uint64_t seed,
                             const procedure::Procedure& procedure = making()) {
  simulation::World world(wrist_with_skin(), procedure, seed);
  ScriptedPortalMaker hands(wrist_with_skin(), procedure, skill, seed);
  while (!hands.is_done() && world.now().tick < kLongest) world.step(hands.next(world.now()));
  EXPECT_TRUE(hands.is_done());
  return world.now();
}

TEST(ScriptedPortalMaker, AnExpertMakesBothShallowAlongAndSpread) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const simulation::Snapshot last = operate(Skill::Expert, seed);
    ASSERT_EQ(last.skin.facts.made, procedure::kPortalsMade) << seed;
    for (const procedure::PortalMade& made : last.skin.facts.portal) {
      EXPECT_TRUE(made.needle.is_in);
      EXPECT_TRUE(made.is_spread);
      EXPECT_EQ(made.out_of_order, 0);
      EXPECT_LT(made.cut.deepest_mm, 2.5) << "the skin alone";
      EXPECT_GT(made.cut.length_mm, 2.5);
      EXPECT_LT(made.cut.length_mm, 6.0);
      EXPECT_GT(made.cut.along_cosine, 0.8);
      EXPECT_LT(made.sheath.skin_off_mm, 2.5);
      EXPECT_LT(made.overrun_mm, 6.0);
    }
  }
}

TEST(ScriptedPortalMaker, ANoviceCutsDeeperAndGoesInFarther) {
  double expert_deep = 0.0;
  double novice_deep = 0.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    expert_deep += operate(Skill::Expert, seed).skin.facts.portal[0].cut.deepest_mm;
    novice_deep += operate(Skill::Novice, seed).skin.facts.portal[0].cut.deepest_mm;
  }
  EXPECT_GT(novice_deep, expert_deep + 3.0);
}

TEST(ScriptedPortalMaker, WhatIsOpenedFirstIsPrickedInTheWound) {
  procedure::Procedure opened = making();
  opened.making->landmarks[1].is_opened_first = true;
  const simulation::Snapshot last = operate(Skill::Expert, 1, opened);
  ASSERT_EQ(last.skin.facts.made, procedure::kPortalsMade);
  for (const procedure::PortalMade& made : last.skin.facts.portal) {
    EXPECT_TRUE(made.needle.is_in);
    EXPECT_TRUE(made.is_spread);
    EXPECT_EQ(made.out_of_order, 0);
  }
}

TEST(ScriptedPortalMaker, TheSameSeedIsTheSameHands) {
  EXPECT_EQ(operate(Skill::Middle, 5).state_hash, operate(Skill::Middle, 5).state_hash);
  EXPECT_NE(operate(Skill::Middle, 5).state_hash, operate(Skill::Middle, 6).state_hash);
}

TEST(ScriptedPortalMaker, AWristWithoutASecondPortalIsRefused) {
  EXPECT_THROW(ScriptedPortalMaker(box_wrist(), making(), Skill::Expert, 1), InvalidInput);
}

}  // namespace
}  // namespace carpus::trainee
