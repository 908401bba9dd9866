// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Scripted hands make two portals through a plate of skin and look into the box by them.
#include "trainee/entering_arthroscopist.hpp"

#include <gtest/gtest.h>

#include "simulation/skin_over_box_test_support.hpp"

namespace carpus::trainee {
namespace {

using namespace simulation::box_joint;  // NOLINT(google-build-using-namespace)

constexpr Tick kLongest = 400'000;

const procedure::Procedure& from_the_skin() {
  static const procedure::Procedure kProcedure = [] {
    procedure::Procedure made = making();
    made.tray.push_back(tool("arthroscope_1_9_30"));
    made.tray.push_back(tool("hook_probe"));
    return made;
  }();
  return kProcedure;
}

TEST(EnteringArthroscopist, KnowsAProcedureByPortalsThatAreMadeAndAScope) {
  EXPECT_TRUE(EnteringArthroscopist::knows(from_the_skin()));
  EXPECT_FALSE(EnteringArthroscopist::knows(making()));
  EXPECT_FALSE(EnteringArthroscopist::knows(probe_alone()));
}

TEST(EnteringArthroscopist, LooksIntoTheJointByThePortalsThatItMade) {
  simulation::World world(wrist_with_skin(), from_the_skin(), 1);
  EnteringArthroscopist hands(wrist_with_skin(), from_the_skin(), Skill::Expert, 1);
  while (!world.now().finished && world.now().tick < kLongest) world.step(hands.next(world.now()));
  ASSERT_TRUE(world.now().finished);
  const procedure::OperationRecord record = world.operation_record();
  EXPECT_EQ(record.making->made, procedure::kPortalsMade);
  EXPECT_GE(record.scope->entries, 1U);
  EXPECT_EQ(record.scope->pull_outs, 0U);
  EXPECT_EQ(record.scope->facts.points_seen, 1U << 16U) << "the one place that there is";
}

}  // namespace
}  // namespace carpus::trainee
