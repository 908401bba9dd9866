// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A shaver in a box of a joint: tufts stand on its floor about place 16, or its floor is a torn
// disc.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "core/state_hash.hpp"
#include "simulation/detail/bytes.hpp"
#include "simulation/lesions_of.hpp"
#include "simulation/tissue_over_box_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::test {
// Defined once in this program, where allocation_guard_test.cpp includes it.
void start_counting_allocations() noexcept;
int stop_counting_allocations() noexcept;
}  // namespace carpus::test

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

constexpr double kDown = 180.0;  // the mouth is turned to the floor
const Vec3 kBare = kMiddle + Vec3{-6, -8, -kHalfHigh};

instruments::Mouth mouth() {
  return *instruments::catalogue()[*instruments::instrument_of("shaver_2_0")].mouth;
}

const auto kTray = {"shaver_2_0", "hook_probe"};

const procedure::Procedure& inflamed() {
  static const procedure::Procedure kProcedure = inflamed_with(kTray);
  return kProcedure;
}

const procedure::Procedure& torn() {
  static const procedure::Procedure kProcedure = torn_with(kTray);
  return kProcedure;
}

const cases::CaseData& wrist_with_disc() {
  static const cases::CaseData kData = box_wrist_with(map_with_disc());
  return kData;
}

const procedure::ShavingFacts& facts(const Hand& hand) { return hand.now().scope.facts.shaving; }

void turn_mouth(Hand& hand, double deg) {
  Command turn;
  turn.kind = CommandKind::TurnMouth;
  turn.rotation_deg = deg;
  hand.command(turn);
}

/// Leads the shaver so that its mouth lies on a place of the floor, or as far over it.
void lay_mouth(Hand& hand, const Vec3& place, double over_mm = 0.2) {
  const Vec3 skin = kMiddle + Vec3{kHalf + 6, 0, 0};
  Vec3 tip = place;
  for (int i = 0; i < 20; ++i) {
    const Vec3 shaft = normalized_or(skin - tip, {1, 0, 0});
    const Vec3 across = normalized_or(Vec3{0, 0, 1} - shaft * shaft.z, {0, 0, 1});
    tip = place + Vec3{0, 0, over_mm} - shaft * mouth().behind_mm + across;
  }
  hand.go(tip + Vec3{0, 0, 1.5});
  hand.go(tip, 100);
}

Vec3 first_tuft() {
  static const Vec3 kAt = lesions_of(box_wrist(), inflamed(), 1)->pieces.front().at;
  return kAt;
}

int left(const Hand& hand) {
  int sum = 0;
  for (std::size_t i = 0; i < hand.now().scope.piece_count; ++i) {
    sum += hand.now().scope.pieces_left[i];
  }
  return sum;
}

void run(Hand& hand, int ticks) {
  hand.drive(Driver::Forward);
  for (int i = 1; i < ticks; ++i) hand.step();
  hand.drive(Driver::Off);
}

TEST(Shavers, RunOnlyWhileDrivenForwardAndTakeWhatIsInTheMouth) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  turn_mouth(hand, kDown);
  EXPECT_EQ(hand.now().scope.mouth_deg[0], kDown);
  enter(hand);
  lay_mouth(hand, first_tuft());
  ASSERT_EQ(hand.now().scope.piece_count, 6);
  EXPECT_EQ(facts(hand).ill, 6);
  for (const Driver driver : {Driver::Off, Driver::Reverse}) {
    hand.drive(driver);
    for (int i = 0; i < 300; ++i) hand.step();
    EXPECT_FALSE(hand.now().scope.are_running[0]);
    EXPECT_EQ(left(hand), 600);
    EXPECT_EQ(facts(hand).running_ticks, 0U);
  }
  hand.drive(Driver::Forward);
  EXPECT_TRUE(hand.now().scope.are_running[0]);
  for (int i = 0; i < 50; ++i) hand.step();
  EXPECT_LT(left(hand), 600);
  EXPECT_EQ(facts(hand).ill_removed, 0) << "it takes its time";
  for (int i = 0; i < 150; ++i) hand.step();
  EXPECT_GE(facts(hand).ill_removed, 1);
  EXPECT_EQ(facts(hand).running_ticks, 201U);
  EXPECT_EQ(facts(hand).unseen_ticks, 201U) << "no scope is in";
  EXPECT_EQ(facts(hand).sound, 0);
}

TEST(Shavers, WhatIsBehindTheMouthStaysUntilItIsTurned) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  enter(hand);
  lay_mouth(hand, first_tuft());
  run(hand, 400);
  EXPECT_EQ(left(hand), 600) << "it is turned distally";
  EXPECT_EQ(facts(hand).lining_ticks, 0U) << "and nothing is there";
  turn_mouth(hand, kDown);
  run(hand, 400);
  EXPECT_LT(left(hand), 600);
}

TEST(Shavers, BareWallAndTheWayInAreCounted) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  hand.go(kMiddle + Vec3{kHalf + 3, 0, 0}, 50);
  ASSERT_FALSE(hand.now().scope.facts.is_in_joint[0]);
  run(hand, 120);
  EXPECT_EQ(facts(hand).way_ticks, 120U);
  EXPECT_EQ(facts(hand).running_ticks, 0U);
  turn_mouth(hand, kDown);
  hand.go(kMiddle);
  run(hand, 200);
  EXPECT_EQ(facts(hand).lining_ticks, 0U) << "amid the joint";
  lay_mouth(hand, kBare);
  run(hand, 249);
  EXPECT_EQ(facts(hand).lining_ticks, 249U);
  EXPECT_FALSE(test::has_event(hand.now(), EventKind::ShaverHarmed));
  hand.drive(Driver::Forward);
  EXPECT_TRUE(test::has_event(hand.now(), EventKind::ShaverHarmed)) << "told once";
  hand.step();
  EXPECT_FALSE(test::has_event(hand.now(), EventKind::ShaverHarmed));
  EXPECT_EQ(facts(hand).cartilage_ticks, 0U) << "no bone is near";
  EXPECT_EQ(facts(hand).way_ticks, 120U);
  turn_mouth(hand, 0);
  const auto before = facts(hand).lining_ticks;
  run(hand, 100);
  EXPECT_EQ(facts(hand).lining_ticks, before) << "its mouth is turned away";
}

TEST(Shavers, AMouthIsTurnedOnlyInAHandThatHoldsAShaver) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  hand.step();
  Command turn;
  turn.kind = CommandKind::TurnMouth;
  turn.rotation_deg = 90;
  const auto why = [&](const Command& command) { return why_not(inflamed(), hand.now(), command); };
  EXPECT_EQ(why(turn), Refusal::None);
  turn.hand = 1;
  EXPECT_EQ(why(turn), Refusal::NothingInHand) << "an empty one";
  turn.hand = 0;
  turn.rotation_deg = 181;
  EXPECT_EQ(why(turn), Refusal::UnknownCommand);
  turn.rotation_deg = std::nan("");
  EXPECT_EQ(why(turn), Refusal::UnknownCommand);
  hand.command(test::take("hook_probe"));
  turn.rotation_deg = 90;
  EXPECT_EQ(why(turn), Refusal::NothingInHand) << "a probe has no mouth";
  turn_mouth(hand, 90);
  EXPECT_EQ(hand.now().scope.mouth_deg[0], 0.0);
}

/// Breaks off in the middle of cutting, reads it back and goes on with the pedal down.
void go_on_from_a_keyframe(const cases::CaseData& data,
                           const procedure::Procedure& declared,
                           const Vec3& place,
                           int ticks) {
  World world(data, declared, 1);
  Hand hand(world);
  turn_mouth(hand, kDown);
  enter(hand);
  lay_mouth(hand, place);
  hand.drive(Driver::Forward);
  for (int i = 0; i < ticks; ++i) hand.step();
  const int before = left(hand);
  ASSERT_LT(before, 100 * hand.now().scope.piece_count);
  ASSERT_GE(facts(hand).ill_removed + facts(hand).sound_removed, 1);
  World again(data, declared, 1);
  const auto taken = again.read_state(world.write_state());
  ASSERT_TRUE(taken.has_value()) << taken.error();
  EXPECT_EQ(again.write_state(), world.write_state());
  Input on = hand.inputs.back();
  for (int i = 0; i < 1200; ++i) {
    on.hands[0].tip_in_patient += Vec3{-0.001, 0, 0};
    world.step(on);
    again.step(on);
    ASSERT_EQ(again.now().state_hash, world.now().state_hash) << i;
  }
  EXPECT_LT(left(hand), before) << "it was cut on";
  EXPECT_EQ(again.now().scope, world.now().scope);
  EXPECT_EQ(again.now().sheets[0].off, world.now().sheets[0].off);
}

TEST(Shavers, GoOnFromAKeyframeToTheSameBits) {
  go_on_from_a_keyframe(box_wrist(), inflamed(), first_tuft(), 220);
  go_on_from_a_keyframe(wrist_with_disc(), torn(), kMiddle + Vec3{0, 0, -kHalfHigh}, 700);
}

TEST(Shavers, AKeyframeThatNoTickLeftIsRefused) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  turn_mouth(hand, 123.5);
  std::vector<std::byte> bytes = world.write_state();
  // How the mouth is turned, which no other field is.
  const double turned = 123.5;
  std::array<std::byte, sizeof turned> field;
  std::memcpy(field.data(), &turned, sizeof turned);
  const auto at = std::search(bytes.begin(), bytes.end(), field.begin(), field.end());
  ASSERT_NE(at, bytes.end());
  for (const double deg : {-90.0, 999.0}) {
    std::memcpy(&*at, &deg, sizeof deg);
    constexpr std::size_t kChecksum = 8;
    ASSERT_GT(bytes.size(), kChecksum);
    const std::size_t body = bytes.size() - kChecksum;
    StateHash hash;
    hash.add_bytes(std::span(bytes).first(body));
    detail::Writer sum;
    sum.put(hash.value(), kChecksum);
    std::copy(sum.bytes().begin(), sum.bytes().end(),
              bytes.begin() + static_cast<std::ptrdiff_t>(body));
    World other(box_wrist(), inflamed(), 1);
    EXPECT_EQ(other.read_state(bytes).has_value(), deg == -90.0) << deg;
  }
}

TEST(Shavers, NoTickAllocatesWhileOneCuts) {
  World first(wrist_with_disc(), torn(), 1);
  Hand hand(first);
  turn_mouth(hand, kDown);
  enter(hand);
  lay_mouth(hand, kMiddle + Vec3{0, 0, -kHalfHigh}, 0.0);
  run(hand, 1000);
  ASSERT_GT(facts(hand).ill_removed + facts(hand).sound_removed, 0);
  World world(wrist_with_disc(), torn(), 1);
  carpus::test::start_counting_allocations();
  for (const Input& each : hand.inputs) world.step(each);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(world.now().state_hash, first.now().state_hash);
}

/// With a second portal, from the side, by which a scope goes in.
const cases::CaseData& wrist_with_two_portals() {
  static const cases::CaseData data = [] {
    cases::CaseData made = box_wrist();
    cases::ArthroscopicMap map = *made.arthroscopy;
    cases::Portal beside = map.portals.front();
    beside.id = "6R";
    beside.skin = kMiddle + Vec3{0, kHalf + 6, 0};
    beside.inwards = {0, -1, 0};
    map.portals.push_back(beside);
    made.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
    return made;
  }();
  return data;
}

/// The other hand brings a scope in and lays its tip there, looking to the floor.
void bring_in_scope(World& world, Input& input, const Vec3& to) {
  input.command = test::take("arthroscope_1_9_30", 1);
  input.hands[1].shaft_in_patient = {0, 1, 0};
  input.hands[1].tip_in_patient = kMiddle + Vec3{0, 40, 0};
  world.step(input);
  input.command = {};
  input.command.kind = CommandKind::TurnScope;
  input.command.rotation_deg = 180;
  world.step(input);
  input.command = {};
  for (const Vec3& next : {kMiddle + Vec3{0, kHalf - 1, 0}, to}) {
    Vec3& tip = input.hands[1].tip_in_patient;
    const Vec3 from = tip;
    constexpr int kTicks = 1500;
    for (int i = 1; i <= kTicks; ++i) {
      tip = from + (next - from) * (static_cast<double>(i) / kTicks);
      world.step(input);
    }
  }
}

TEST(Shavers, AScopeSeesTuftsAndMouthAndIsRunAgainstWhereItIsInTheWay) {
  procedure::Procedure seen = inflamed();
  seen.tray.push_back(*instruments::instrument_of("arthroscope_1_9_30"));
  World world(wrist_with_two_portals(), seen, 1);
  Hand hand(world);
  turn_mouth(hand, kDown);
  enter(hand);
  lay_mouth(hand, first_tuft());
  EXPECT_EQ(facts(hand).patches_seen, 0);
  Input input = hand.inputs.back();
  const Vec3 mouth_at = first_tuft() + Vec3{0, 0, 0.2};
  bring_in_scope(world, input, mouth_at + Vec3{0, 6, 3});
  const procedure::ShavingFacts& done = world.now().scope.facts.shaving;
  ASSERT_TRUE(world.now().scope.facts.is_in_joint[1]);
  for (int i = 0; i < 1500; ++i) world.step(input);
  EXPECT_EQ(done.patches_seen, 1) << "for a second";
  input.hands[0].driver = Driver::Forward;
  for (int i = 0; i < 100; ++i) world.step(input);
  EXPECT_EQ(done.running_ticks, 100U);
  EXPECT_EQ(done.unseen_ticks, 0U);
  EXPECT_EQ(done.scope_ticks, 0U);
  input.hands[0].driver = Driver::Off;
  for (int i = 0; i < 1000; ++i) {
    input.hands[1].tip_in_patient += Vec3{0, -0.0054, -0.0022};
    world.step(input);
  }
  input.hands[0].driver = Driver::Forward;
  bool is_told = false;
  for (int i = 0; i < 300; ++i) {
    world.step(input);
    is_told = is_told || test::has_event(world.now(), EventKind::ShaverHarmed);
  }
  EXPECT_EQ(done.scope_ticks, 300U);
  EXPECT_TRUE(is_told);
}

/// How deep a probe comes that is led below the disc at this place.
double deep_at(Hand& hand, const Vec3& place) {
  hand.go(kMiddle);
  hand.go(kMiddle + Vec3{40, 0, 0}, 50);
  hand.command(test::take("hook_probe"));
  enter(hand);
  hand.go(place + Vec3{0, 0, 1.5});
  hand.go(place - Vec3{0, 0, 1.5}, 50);
  return hand.tip().z;
}

TEST(Shavers, ThroughAHoleThatWasCutAProbeGoesDeeper) {
  const Vec3 place = kMiddle + Vec3{-3, 0, -kHalfHigh};
  const auto after = [&](int ticks) {
    World world(wrist_with_disc(), torn(), 1);
    Hand hand(world);
    turn_mouth(hand, kDown);
    enter(hand);
    lay_mouth(hand, place, 0.0);
    if (ticks > 0) run(hand, ticks);
    EXPECT_EQ(facts(hand).ill_removed + facts(hand).sound_removed > 0, ticks > 0);
    return deep_at(hand, place);
  };
  const double whole = after(0);
  const double cut = after(4000);
  EXPECT_NEAR(cut, -kHalfHigh - 1.5, 0.1) << "nothing holds it";
  EXPECT_GT(whole, cut + 0.3);
}

}  // namespace
}  // namespace carpus::simulation
