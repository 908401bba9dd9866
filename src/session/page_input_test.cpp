// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/page_input.hpp"

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "simulation/permission.hpp"

namespace carpus::session {
namespace {

TEST(PageInput, EachHandIsHeldAndHeardByItself) {
  HeldInput held;
  protocol::Hand message;
  message.hand = 1;
  message.tip_mm = {1, 2, 3};
  message.shaft = {0, 1, 0};
  message.thrust_n = 12;
  message.driver = protocol::Driver::Reverse;
  message.guidance = protocol::Guidance::Planned;
  hold(held, message);
  EXPECT_EQ(held.heard[0], 0U);
  EXPECT_EQ(held.heard[1], 1U);
  EXPECT_EQ(held.hands[0], simulation::HandInput{});
  EXPECT_EQ(held.hands[1].tip_in_patient, (Vec3{1, 2, 3}));
  EXPECT_EQ(held.hands[1].driver, simulation::Driver::Reverse);
  EXPECT_EQ(held.hands[1].guidance, simulation::Guidance::Planned);
}

TEST(PageInput, ADeclineNamesTheProceduresReasons) {
  procedure::Procedure procedure;
  procedure.decline.reasons = {{"flexed", ""}, {"no_fracture", ""}, {"bone_lost", ""}};
  protocol::Act message;
  message.id = protocol::ActionId::Decline;
  message.reasons = {"flexed", "bone_lost"};
  EXPECT_EQ(command_of(message, procedure)->kind, simulation::CommandKind::Decline);
  EXPECT_EQ(command_of(message, procedure)->index, 0b101);
  message.reasons = {"bored"};
  EXPECT_FALSE(command_of(message, procedure));
}

TEST(PageInput, TheTubeTakesTheNearestVoltage) {
  protocol::Tube message;
  message.tube_kv = 52;
  message.dose_level = protocol::DoseLevel::High;
  EXPECT_EQ(command_of(message).kind, simulation::CommandKind::SetTube);
  EXPECT_EQ(command_of(message).index, 2) << "50 kV, high";
  message.tube_kv = 60;
  message.dose_level = protocol::DoseLevel::Usual;
  EXPECT_EQ(command_of(message).index, procedure::kUsualTube);
}

TEST(PageInput, AMouthIsTurnedInTheHandThatIsNamed) {
  protocol::TurnMouth message;
  message.hand = 1;
  message.mouth_deg = -72.5;
  const simulation::Command command = command_of(message);
  EXPECT_EQ(command.kind, simulation::CommandKind::TurnMouth);
  EXPECT_EQ(command.hand, 1);
  EXPECT_DOUBLE_EQ(command.rotation_deg, -72.5);
}

TEST(PageInput, AnAidIsNamed) {
  protocol::Act message;
  message.id = protocol::ActionId::UseAid;
  EXPECT_FALSE(command_of(message, {}));
  message.aid = protocol::Aid::Hint;
  EXPECT_EQ(command_of(message, {})->index, 2);
}

TEST(PageInput, AJudgementSaysWhich) {
  protocol::Act message;
  message.id = protocol::ActionId::Judge;
  EXPECT_FALSE(command_of(message, {}));
  message.displaced = true;
  EXPECT_EQ(command_of(message, {})->index,
            static_cast<std::uint8_t>(procedure::Judgement::Displaced));
}

/// What is asked for cannot be had by guessing, nor be changed once something was drilled.
TEST(PageInput, AJudgementIsTakenWhereItIsAskedBeforeBoneIsEntered) {
  procedure::Procedure procedure;
  simulation::Snapshot now;
  simulation::Command command{simulation::CommandKind::Judge, 0, 1, 0, 0};
  EXPECT_EQ(why_not(procedure, now, command), simulation::Refusal::UnknownCommand);
  procedure.judges_displacement = true;
  EXPECT_EQ(why_not(procedure, now, command), simulation::Refusal::None);
  for (const int unknown : {0, 3, 255}) {
    command.index = static_cast<std::uint8_t>(unknown);
    EXPECT_EQ(why_not(procedure, now, command), simulation::Refusal::UnknownCommand);
  }
  command.index = 2;
  now.passes = 1;
  EXPECT_EQ(why_not(procedure, now, command), simulation::Refusal::TooLateToJudge);
}

TEST(PageInput, WristIsTakenInRadians) {
  HeldInput held;
  protocol::Wrist message;
  message.flexion_deg = 90;
  message.traction_n = 20;
  hold(held, message);
  EXPECT_DOUBLE_EQ(held.wrist.flexion_rad, kPi / 2);
  EXPECT_EQ(held.wrist.traction_n, 20);
}

TEST(PageInput, ViewsOfAHeldForearmTurnTheCArmWithIt) {
  simulation::WristPose pronated;
  pronated.pronation_rad = radians_from_degrees(60);
  protocol::TakeShot shot;
  shot.rotation_deg = 30;
  shot.tilt_deg = -5;
  EXPECT_DOUBLE_EQ(command_of(shot, pronated).rotation_deg, 90);
  EXPECT_EQ(command_of(shot, pronated).tilt_deg, -5);
  shot.reference = protocol::AngleReference::Room;
  EXPECT_EQ(command_of(shot, pronated).rotation_deg, 30);
  shot.reference = protocol::AngleReference::HeldForearm;
  shot.rotation_deg = 150;
  EXPECT_DOUBLE_EQ(command_of(shot, pronated).rotation_deg, -150) << "once round";
}

TEST(PageInput, FluidIsSetByControlAndValue) {
  const simulation::Command command =
      command_of(protocol::SetFluid{protocol::FluidControl::Dry, 1});
  EXPECT_EQ(command.kind, simulation::CommandKind::SetFluid);
  EXPECT_EQ(command.index, simulation::fluid_index(procedure::FluidControl::Dry, 1));
}

}  // namespace
}  // namespace carpus::session
