// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/device_hands.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "devices/trusted_command.hpp"
#include "instruments/instrument.hpp"

namespace carpus::server {
namespace {

using devices::Health;
using devices::kNsPerMs;
using simulation::Guidance;
using simulation::Input;
using simulation::Snapshot;

/// One hand, its device and the world's answer, a millisecond at a time.
class Desk {
 public:
  Desk() {
    now_state.hands[0].item = 0;
    now_state.items[0].tip_in_patient = {10, 20, 30};
    view.is_used = true;
    view.revision = 1;
    hands.set_view(0, view);
    device.able.position = device.able.absolute = device.able.force = true;
    device.able.peak_force_n = 8;
    device.device.health = Health::Good;
  }
  const Input& tick(bool is_told = true) {
    now += kNsPerMs;
    if (is_told) device.device.heard_ns = now;
    hands.exchange(0).states.publish(device);
    input = Input{};
    input.hands[0].guidance = Guidance::Planned;
    input.hands[0].driver = simulation::Driver::Forward;
    hands.before_at(now, input, now_state);
    now_state.items[0].tip_in_patient = input.hands[0].tip_in_patient;  // nothing in the way
    hands.after_at(now, now_state);
    return input;
  }
  DeviceHands hands;
  DeviceView view;
  devices::LoopState device;
  Snapshot now_state;
  Input input;
  devices::Nanoseconds now = 1'000'000'000;
};

TEST(DeviceHands, TheTipGoesOnFromWhereItIsAsTheDeviceMoves) {
  Desk desk;
  desk.device.device.position_mm = {40, -7, 3};  // wherever the device stands
  EXPECT_EQ(desk.tick().hands[0].tip_in_patient, (Vec3{10, 20, 30}));
  for (int i = 0; i < 10; ++i) {
    desk.device.device.position_mm += Vec3{0.5, 0, 0.2};
    desk.tick();
  }
  // Right is x, up is z, away is up x right.
  EXPECT_LT(distance(desk.input.hands[0].tip_in_patient, {15, 20, 32}), 1e-9);
  EXPECT_EQ(desk.input.hands[0].guidance, Guidance::Direct);
  EXPECT_EQ(desk.input.hands[0].driver, simulation::Driver::Forward);  // the page's own
  EXPECT_EQ(desk.input.hands[1].guidance, Guidance::Direct);
  desk.device.device.position_mm += Vec3{0, 1, 0};
  EXPECT_LT(distance(desk.tick().hands[0].tip_in_patient, {15, 21, 32}), 1e-9);
}

TEST(DeviceHands, AViewThatWasTurnedAPauseAndAJumpLeaveTheTipWhereItIs) {
  Desk desk;
  desk.tick();
  desk.device.device.position_mm = {1, 0, 0};
  const Vec3 there = desk.tick().hands[0].tip_in_patient;
  desk.view.right_in_patient = {0, 1, 0};
  desk.view.revision = 2;
  desk.hands.set_view(0, desk.view);
  EXPECT_LT(distance(desk.tick().hands[0].tip_in_patient, there), 1e-9);
  desk.device.device.position_mm = {2, 0, 0};
  EXPECT_LT(distance(desk.tick().hands[0].tip_in_patient, there + Vec3{0, 1, 0}), 1e-9);
  // No tick for a second, the device was moved meanwhile.
  desk.now += 1000 * kNsPerMs;
  desk.device.device.position_mm = {-30, 4, 9};
  EXPECT_LT(distance(desk.tick().hands[0].tip_in_patient, there + Vec3{0, 1, 0}), 1e-9);
  desk.device.device.position_mm = {30, 4, 9};  // it lost its place
  EXPECT_LT(distance(desk.tick().hands[0].tip_in_patient, there + Vec3{0, 1, 0}), 1e-9);
}

TEST(DeviceHands, ADeviceThatFailsHoldsStillAndDrivesNothing) {
  Desk desk;
  desk.tick();
  desk.device.device.position_mm = {1, 0, 0};
  const Vec3 there = desk.tick().hands[0].tip_in_patient;
  desk.device.device.health = Health::Gone;
  desk.device.device.position_mm = {};
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(desk.tick().hands[0].tip_in_patient, there);
    EXPECT_EQ(desk.input.hands[0].driver, simulation::Driver::Off);
  }
  desk.device.device.health = Health::Good;
  EXPECT_LT(distance(desk.tick().hands[0].tip_in_patient, there), 1e-9);
  for (int i = 0; i < 200; ++i) desk.tick(false);  // silent, and nobody has noticed yet
  EXPECT_EQ(desk.input.hands[0].driver, simulation::Driver::Off);
}

TEST(DeviceHands, ADeviceThatSaysHowFastMovesTheTipSo) {
  Desk desk;
  desk.device.able.absolute = false;
  desk.device.device.velocity_mm_s = {0, 0, 20};
  for (int i = 0; i < 100; ++i) desk.tick(false);  // it says something only when it changes
  EXPECT_NEAR(desk.input.hands[0].tip_in_patient.z, 32, 0.03);
}

TEST(DeviceHands, WhatTheTipMeetsIsAPlaneInTheDevicesFrame) {
  Desk desk;
  desk.tick();
  desk.device.device.position_mm = {0, 0, -1};
  desk.tick();
  // The world held the tip 1 mm above the wish.
  desk.now_state.items[0].tip_in_patient = {10, 20, 30};
  desk.now_state.hands[0].force_in_patient = {0, 0, 2};
  desk.hands.after_at(desk.now, desk.now_state);
  devices::TimedCommand wish;
  ASSERT_TRUE(desk.hands.exchange(0).wishes.take(wish));
  EXPECT_EQ(wish.at_ns, desk.now);
  ASSERT_EQ(wish.command.plane_count, 1);
  EXPECT_LT(distance(wish.command.planes[0].normal, {0, 0, 1}), 1e-9);
  EXPECT_NEAR(wish.command.planes[0].offset_mm, 0, 1e-9);  // the device is 1 mm below it
  EXPECT_EQ(wish.command.limit_n, 8);
  desk.now_state.hands[0].force_in_patient = {};
  desk.hands.after_at(desk.now, desk.now_state);
  ASSERT_TRUE(desk.hands.exchange(0).wishes.take(wish));
  EXPECT_EQ(wish.command.plane_count, 0);
}

TEST(DeviceHands, ASurfaceIsToldBeforeItIsTouched) {
  Desk desk;
  desk.tick();
  desk.now_state.hands[0].ahead = {3, 1.5, {0, 0, 1}, 2.0};
  desk.now_state.items[0].instrument = *instruments::instrument_of("guide_wire");
  desk.hands.after_at(desk.now, desk.now_state);
  devices::TimedCommand wish;
  ASSERT_TRUE(desk.hands.exchange(0).wishes.take(wish));
  ASSERT_EQ(wish.command.plane_count, 1);
  EXPECT_NEAR(wish.command.planes[0].offset_mm, -1.5, 1e-9);
  EXPECT_EQ(devices::force_of(wish.command, {}, {}), Vec3{});
}

TEST(DeviceHands, ADeviceThatGivesForcesIsPushedWithAndAnyOtherIsNot) {
  Desk desk;
  desk.tick();
  desk.device.device.position_mm = {0, 0, -1};
  desk.tick();
  desk.now_state.items[0].tip_in_patient = {10, 20, 30};
  desk.now_state.items[0].shaft_in_patient = {0, 0, 1};
  desk.device.able.most_stiffness_n_per_mm = 2;
  desk.hands.exchange(0).states.publish(desk.device);
  Input input;
  input.hands[0].thrust_n = 20;
  desk.hands.before_at(desk.now, input, desk.now_state);
  // 1 mm deep at 2 N/mm on a device of 8 N: 6.4 N are the hardest bone's 45.
  EXPECT_NEAR(input.hands[0].thrust_n, 2 * 45 / 6.4, 1e-9);
  desk.device.able.force = false;
  desk.device.able.stop = true;
  desk.hands.exchange(0).states.publish(desk.device);
  input.hands[0].thrust_n = 20;
  desk.hands.before_at(desk.now, input, desk.now_state);
  EXPECT_EQ(input.hands[0].thrust_n, 20);
}

TEST(DeviceHands, AToolThatRollsTurnsTheScopeInItsHand) {
  Desk desk;
  desk.device.able.roll = true;
  desk.now_state.scope.hand = 0;
  desk.now_state.scope.shaft_turn_deg = 100;
  desk.now_state.scope.camera_turn_deg = -20;
  desk.device.device.roll_rad = 5.0;  // wherever its sensor begins
  const auto turn_by = [&](double deg) {
    desk.device.device.roll_rad += radians_from_degrees(deg);
    desk.tick();
    const simulation::Command& asked = desk.input.command;
    if (asked.kind != simulation::CommandKind::TurnScope) return false;
    EXPECT_EQ(asked.tilt_deg, -20) << "the camera head is the page's";
    desk.now_state.scope.shaft_turn_deg = asked.rotation_deg;
    return true;
  };
  EXPECT_FALSE(turn_by(0)) << "taken: it stays as it is";
  EXPECT_FALSE(turn_by(0.2)) << "a flicker";
  ASSERT_TRUE(turn_by(29.8));
  EXPECT_NEAR(desk.now_state.scope.shaft_turn_deg, 130, 1e-9);
  EXPECT_FALSE(turn_by(0));
  desk.device.device.roll_rad -= 2 * kPi;  // the sensor's turn is over
  EXPECT_FALSE(turn_by(0));
  ASSERT_TRUE(turn_by(80));
  EXPECT_NEAR(desk.now_state.scope.shaft_turn_deg, -150, 1e-9);
  desk.now_state.scope.shaft_turn_deg = 10;  // by the page: from there on
  EXPECT_FALSE(turn_by(0));
  ASSERT_TRUE(turn_by(-15));
  EXPECT_NEAR(desk.now_state.scope.shaft_turn_deg, -5, 1e-9);
  // Put down, silent, without a sensor or over: nothing turns it.
  desk.now_state.scope.hand = simulation::kNoHand;
  EXPECT_FALSE(turn_by(40));
  desk.now_state.scope.hand = 0;
  EXPECT_FALSE(turn_by(0)) << "taken again: not by what the handle did meanwhile";
  desk.device.device.health = Health::Silent;
  EXPECT_FALSE(turn_by(40));
  desk.device.device.health = Health::Good;
  EXPECT_FALSE(turn_by(0));
  desk.device.able.roll = false;
  EXPECT_FALSE(turn_by(40));
  desk.device.able.roll = true;
  EXPECT_FALSE(turn_by(0));
  desk.now_state.finished = true;
  EXPECT_FALSE(turn_by(40));
}

TEST(DeviceHands, AScopeIsTurnedOnlyWhereNobodyElseHasACommandInTheTick) {
  Desk desk;
  desk.device.able.roll = true;
  desk.now_state.scope.hand = 0;
  desk.tick();
  desk.device.device.roll_rad = radians_from_degrees(30);
  desk.hands.exchange(0).states.publish(desk.device);
  Input input;
  input.command.kind = simulation::CommandKind::Finish;
  desk.hands.before_at(desk.now, input, desk.now_state);
  EXPECT_EQ(input.command.kind, simulation::CommandKind::Finish);
  desk.tick();
  EXPECT_EQ(desk.input.command.kind, simulation::CommandKind::TurnScope);
  EXPECT_NEAR(desk.input.command.rotation_deg, 30, 1e-9);
}

TEST(DeviceHands, AHandOfThePageIsLeftAlone) {
  Desk desk;
  desk.view.is_used = false;
  desk.view.revision = 2;
  desk.hands.set_view(0, desk.view);
  EXPECT_EQ(desk.tick().hands[0].guidance, Guidance::Planned);
  devices::TimedCommand wish;
  EXPECT_FALSE(desk.hands.exchange(0).wishes.take(wish));
}

}  // namespace
}  // namespace carpus::server
