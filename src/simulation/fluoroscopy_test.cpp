// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Looks through the C-arm: what they cost, what of them stays on record.
#include <gtest/gtest.h>

#include <limits>

#include "procedure/shots.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation {
namespace {

using procedure::Look;
using test::exercise;
using test::wrist;

class Looker {
 public:
  Looker() {
    input_.wrist = world.now().wrist;
    for (HandInput& hand : input_.hands) hand.tip_in_patient = {0, 150, 0};  // far from all bone
  }

  const Snapshot& look(double rotation_deg, bool pedal, int ticks) {
    input_.c_arm = {rotation_deg, 0.0, pedal};
    for (int i = 0; i < ticks; ++i) {
      const Snapshot& now = world.step(input_);
      for (std::size_t e = 0; e < now.event_count; ++e) last_event = now.events[e];
    }
    return world.now();
  }
  const Snapshot& shoot(double rotation_deg) {
    input_.command = test::shot(rotation_deg);
    world.step(input_);
    input_.command = {};
    return world.now();
  }
  void set_tube(std::uint8_t setting, bool pedal = false) {
    input_.c_arm.pedal_is_down = pedal;
    input_.command = {CommandKind::SetTube, 0, setting, 0, 0};
    world.step(input_);
    input_.command = {};
  }
  void flex(double rad) { input_.wrist.flexion_rad = rad; }
  void pronate(double angle_rad) { input_.wrist.pronation_rad = angle_rad; }
  [[nodiscard]] std::vector<procedure::Shot> shots() const {
    return world.operation_record().shots;
  }

  World world{wrist(), exercise(), 1};
  Event last_event;

 private:
  Input input_;
};

TEST(Fluoroscopy, WhatTheTubeIsSetToIsPaidAndNoted) {
  Looker looker;
  looker.shoot(0);
  const std::uint64_t usual = looker.world.now().dose_units;
  EXPECT_EQ(procedure::dose_cgy_cm2(usual), procedure::kDosePerShotCgyCm2);
  looker.set_tube(6);  // 70 kV, low
  looker.shoot(0);
  EXPECT_EQ(looker.shots()[1].tube, 6);
  EXPECT_EQ((looker.world.now().dose_units - usual) * 3600 * 2, usual * 4900);
  looker.set_tube(procedure::kTubeSettings);
  EXPECT_EQ(looker.world.now().tube, 6) << "there is no such setting";
}

TEST(Fluoroscopy, ALiveLookIsNotedAnewWhenTheTubeChanges) {
  Looker looker;
  looker.look(0, true, 500);
  looker.set_tube(8, true);
  looker.look(0, true, 500);
  const auto shots = looker.shots();
  ASSERT_EQ(shots.size(), 2U);
  EXPECT_EQ(shots[0].tube, procedure::kUsualTube);
  EXPECT_EQ(shots[1].tube, 8);
  EXPECT_EQ(looker.world.now().dose_units,
            procedure::dose_units_of(shots[0]) + procedure::dose_units_of(shots[1]));
}

TEST(Fluoroscopy, PedalGivesTenPulsesASecondAndOneLook) {
  Looker looker;
  const Snapshot& live = looker.look(0, true, 1000);
  EXPECT_EQ(live.pulses, 10U);
  EXPECT_EQ(live.looks, 1U);
  EXPECT_TRUE(live.c_arm.pedal_is_down);
  const Snapshot& after = looker.look(0, false, 500);
  EXPECT_EQ(after.pulses, 10U) << "nothing while it is up";
  EXPECT_FALSE(after.c_arm.pedal_is_down);
  EXPECT_EQ(looker.last_event.kind, EventKind::LiveEnded);
  EXPECT_EQ(looker.last_event.detail, 1);
  EXPECT_DOUBLE_EQ(looker.last_event.value, 1.0);
  ASSERT_EQ(looker.shots().size(), 1U);
  EXPECT_EQ(looker.shots()[0].look, Look::Live);
  EXPECT_EQ(looker.shots()[0].pulses, 10U);
}

TEST(Fluoroscopy, TapOfThePedalIsOnePulse) {
  Looker looker;
  looker.look(0, true, 1);
  looker.look(0, false, 1);
  looker.look(0, true, 1);
  EXPECT_EQ(looker.look(0, false, 1).pulses, 2U);
  EXPECT_EQ(looker.world.now().looks, 2U);
}

TEST(Fluoroscopy, EveryViewThatALiveLookSweepsIsOnRecordButCountsAsOneLook) {
  Looker looker;
  for (int angle = 0; angle <= 90; ++angle) looker.look(angle, true, 100);
  const auto shots = looker.shots();
  ASSERT_EQ(shots.size(), 5U) << "0, 20, 40, 60, 80 degrees";
  std::uint32_t pulses = 0;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    EXPECT_DOUBLE_EQ(shots[i].rotation_deg, 20.0 * static_cast<double>(i));
    EXPECT_EQ(shots[i].look, i == 0 ? Look::Live : Look::LiveOn);
    pulses += shots[i].pulses;
  }
  EXPECT_EQ(pulses, 91U) << "no pulse is lost between entries";
  EXPECT_EQ(looker.world.now().pulses, 91U);
  EXPECT_EQ(looker.world.now().looks, 1U);
}

TEST(Fluoroscopy, ForearmThatTurnsUnderTheLiveBeamIsSeenFromOtherSides) {
  Looker looker;
  looker.pronate(-0.8);
  looker.look(0, true, 2000);
  const auto shots = looker.shots();
  ASSERT_EQ(shots.size(), 3U);
  EXPECT_NEAR(shots[2].rotation_deg - shots[0].rotation_deg, 40.0, 7.0);
}

TEST(Fluoroscopy, WristThatMovesUnderTheLiveBeamIsOnRecordByTenDegrees) {
  Looker looker;
  const double before = looker.world.now().wrist.flexion_rad;
  looker.flex(before - 0.6);
  looker.look(0, true, 4000);
  const auto shots = looker.shots();
  ASSERT_GE(shots.size(), 3U);
  EXPECT_LE(shots.size(), 5U);
  EXPECT_NEAR(shots.front().wrist.flexion_rad - shots.back().wrist.flexion_rad, 0.55, 0.12);
}

TEST(Fluoroscopy, SingleShotCostsWhatFiveSecondsOfLiveLookingDo) {
  Looker single;
  single.shoot(0);
  Looker live;
  live.look(0, true, 5000);
  EXPECT_EQ(single.world.now().pulses, live.world.now().pulses);
  EXPECT_DOUBLE_EQ(procedure::dose_cgy_cm2(single.world.now().dose_units),
                   procedure::kDosePerShotCgyCm2);
}

TEST(Fluoroscopy, ShotInTheMiddleOfALiveLookIsAnEntryOfItsOwn) {
  Looker looker;
  looker.look(0, true, 50);
  looker.shoot(0);  // lets the pedal stand where it is
  looker.look(0, true, 100);
  const auto shots = looker.shots();
  ASSERT_EQ(shots.size(), 3U);
  EXPECT_EQ(shots[1].look, Look::Single);
  EXPECT_EQ(shots[2].look, Look::LiveOn);
  EXPECT_EQ(looker.world.now().looks, 2U);
}

TEST(Fluoroscopy, StandThatNoCArmTakesLetsThePedalGo) {
  Looker looker;
  looker.look(10, true, 100);
  const Snapshot& now = looker.look(std::numeric_limits<double>::quiet_NaN(), true, 10);
  EXPECT_FALSE(now.c_arm.pedal_is_down);
  EXPECT_DOUBLE_EQ(now.c_arm.rotation_deg, 10.0) << "it stays where it stood";
  EXPECT_EQ(looker.world.faults().bad_inputs, 10U);
}

TEST(Fluoroscopy, LookIsOnRecordHoweverManyThereWere) {
  Looker looker;
  for (std::size_t i = 0; i < kMaxShots; ++i) looker.shoot(0);
  const std::uint32_t before = looker.world.now().pulses;
  looker.look(45, true, 1000);
  looker.look(45, false, 1);
  EXPECT_EQ(looker.shots().size(), kMaxShots);
  EXPECT_EQ(looker.world.now().pulses, before + 10) << "its dose counts all the same";
}

TEST(Fluoroscopy, LookGoesOnFromAKeyframe) {
  Looker one;
  one.look(30, true, 1234);
  Looker other;
  ASSERT_TRUE(other.world.read_state(one.world.write_state()).has_value());
  EXPECT_EQ(one.look(30, true, 1000).state_hash, other.look(30, true, 1000).state_hash);
  EXPECT_EQ(one.shots(), other.shots());
}

}  // namespace
}  // namespace carpus::simulation
