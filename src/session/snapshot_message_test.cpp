// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/snapshot_message.hpp"

#include <gtest/gtest.h>

#include "session/action_list.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::session {
namespace {

using simulation::test::exercise;
using simulation::test::wrist;

/// A screw in the scaphoid, a hand that touches the radius, a step done.
simulation::Snapshot operated(procedure::Mode mode) {
  simulation::Snapshot now;
  now.mode = mode;
  now.completed_steps = 1;
  now.holding_share = 0.4;
  simulation::ItemView& item = now.items[0];
  item.instrument = *instruments::instrument_of("acutrak_2_mini_20");
  item.body = item.tip_body = simulation::test::body_of(BoneId::Scaphoid);
  item.in_target = true;
  item.tip_hu = 500;
  item.depth_mm = 22;
  item.buried_mm = 2;
  now.hands[0].touching = true;
  now.hands[0].touched_body = simulation::test::body_of(BoneId::Radius);
  return now;
}

TEST(SnapshotMessage, PracticeTellsWhatIsTrue) {
  const auto told = snapshot_message(operated(procedure::Mode::Practice), {}, BodyNames(wrist()));
  EXPECT_EQ(told.completed_steps.size(), 1U);
  EXPECT_EQ(told.items.at(0).body, "scaphoid");
  EXPECT_TRUE(told.items.at(0).in_target);
  EXPECT_EQ(told.items.at(0).buried_mm, 2.0);
  EXPECT_EQ(told.hands.at(0).touched_body, "radius");
}

TEST(SnapshotMessage, AnAssessedOperationIsToldNoBone) {
  const simulation::Snapshot now = operated(procedure::Mode::Assessed);
  const auto told = snapshot_message(now, {}, BodyNames(wrist()));
  EXPECT_TRUE(told.completed_steps.empty());
  EXPECT_EQ(told.holding_share, 1.0);
  EXPECT_EQ(told.hands.at(0).touched_body, "bone");
  const protocol::Item& item = told.items.at(0);
  EXPECT_EQ(item.body, "bone") << "it is fixed, no more";
  EXPECT_FALSE(item.in_target);
  EXPECT_EQ(item.tip_body, "");
  EXPECT_EQ(item.tip_hu, 0.0);
  EXPECT_EQ(item.buried_mm, 0.0);
  EXPECT_EQ(item.depth_mm, 22.0) << "is seen on the instrument";
  for (const protocol::Action& action :
       actions_message(exercise(), now, BodyNames(wrist())).actions) {
    EXPECT_EQ(action.label.find("scaphoid"), std::string::npos) << action.label;
  }
}

}  // namespace
}  // namespace carpus::session
