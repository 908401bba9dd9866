// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/held_input.hpp"

#include <gtest/gtest.h>

namespace carpus::session {
namespace {

using simulation::Driver;

HeldInput drilling_with_both() {
  HeldInput held;
  for (auto& hand : held.hands) hand.driver = Driver::Forward;
  held.heard = {1, 1};
  return held;
}

TEST(InputSource, StopsADriverWhoseHandIsNotHeardOfAndOnlyThat) {
  HeldInput held = drilling_with_both();
  InputSource source(HeldInput{});
  source.hold(held);
  for (Tick tick = 0; tick < 2 * InputSource::kDriverHoldTicks; ++tick) {
    if (tick % 40 == 0) {
      ++held.heard[1];
      source.hold(held);
    }
    const simulation::Input input = source.input({});
    EXPECT_EQ(input.hands[0].driver,
              tick < InputSource::kDriverHoldTicks ? Driver::Forward : Driver::Off)
        << "tick " << tick;
    EXPECT_EQ(input.hands[1].driver, Driver::Forward);
    source.passed();
  }
  ++held.heard[0];
  source.hold(held);
  EXPECT_EQ(source.input({}).hands[0].driver, Driver::Forward);
}

TEST(InputSource, CountsTicksThatPassedAndNotHowOftenItWasAsked) {
  InputSource source(HeldInput{});
  source.hold(drilling_with_both());
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(source.input({}).hands[0].driver, Driver::Forward);
  }
}

TEST(InputSource, KeepsWhatIsHeldAndAddsTheCommand) {
  HeldInput held = drilling_with_both();
  held.hands[1].tip_in_patient = {1, 2, 3};
  held.wrist.flexion_rad = 0.5;
  InputSource source(held);
  simulation::Command command;
  command.kind = simulation::CommandKind::Undo;
  const simulation::Input input = source.input(command);
  EXPECT_EQ(input.hands[1].tip_in_patient, (Vec3{1, 2, 3}));
  EXPECT_EQ(input.wrist.flexion_rad, 0.5);
  EXPECT_EQ(input.command, command);
}

}  // namespace
}  // namespace carpus::session
