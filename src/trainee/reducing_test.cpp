// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/reducing.hpp"

#include <gtest/gtest.h>

#include "procedures/built_in.hpp"
#include "simulation/broken_wrist_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::trainee {
namespace {

using simulation::test::broken_wrist;

const procedure::Procedure& dorsal() {
  return *procedures::built_in().find("dorsal_scaphoid_fixation");
}

TEST(Reducing, LeadsTheFragmentsTogetherAndLetsGo) {
  simulation::World world(broken_wrist(), dorsal(), 1);
  Reducing reducing(broken_wrist(), dorsal());
  const auto before = reducing.offset(world.now());
  ASSERT_TRUE(before.has_value());
  EXPECT_GT(before->gap_mm, 2.0);
  simulation::Input input;
  input.wrist = dorsal().opening(broken_wrist()).wrist;
  input.hands[0].tip_in_patient = {0, 150, 0};
  constexpr int kPosingTicks = 3000;
  for (int tick = 0; tick < kPosingTicks; ++tick) world.step(input);
  reducing.begin(world.now(), {{0, 150, 50}, {0, 1, 0}}, {});
  int ticks = 0;
  for (; ticks < 60000; ++ticks) {
    input.command = {};
    if (reducing.next(world.now(), input)) break;
    world.step(input);
  }
  EXPECT_LT(ticks, 60000) << "it ends by itself";
  const auto after = reducing.offset(world.now());
  EXPECT_LT(after->gap_mm, 1.0);
  EXPECT_LT(after->step_mm, 0.5);
  EXPECT_GT(after->cosine_angle, 0.98);
  EXPECT_EQ(world.now().hands[1].item, simulation::kNoItem);
  std::size_t left = 0;
  for (const simulation::ItemView& item : world.now().items) {
    if (item.body != simulation::kNoBody) ++left;
  }
  EXPECT_EQ(left, 1U) << "the joystick holds what it led";

  ASSERT_TRUE(reducing.has_left_wire());
  reducing.begin_taking_out();
  for (ticks = 0; ticks < 60000; ++ticks) {
    input.command = {};
    if (reducing.next(world.now(), input)) break;
    world.step(input);
  }
  EXPECT_LT(ticks, 60000);
  EXPECT_FALSE(reducing.has_left_wire());
  for (const simulation::ItemView& item : world.now().items) {
    EXPECT_EQ(item.body, simulation::kNoBody) << "it is out before the wrist is straightened";
  }
  EXPECT_LT(reducing.offset(world.now())->step_mm, 0.5) << "and nothing sprang back";
}

TEST(Reducing, HasNothingToDoAtAWholeBone) {
  const Reducing reducing(simulation::test::wrist(), dorsal());
  simulation::World world(simulation::test::wrist(), dorsal(), 1);
  EXPECT_FALSE(reducing.offset(world.now()).has_value());
}

}  // namespace
}  // namespace carpus::trainee
