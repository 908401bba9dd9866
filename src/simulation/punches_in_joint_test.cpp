// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A punch in a box of a joint: its floor is a torn disc, or tufts stand on it about place 16.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/state_hash.hpp"
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

instruments::Bite bite() {
  return *instruments::catalogue()[*instruments::instrument_of("punch_2_0")].bite;
}

const auto kTray = {"punch_2_0", "shaver_2_0", "hook_probe", "arthroscope_1_9_30"};

const procedure::Procedure& torn() {
  static const procedure::Procedure kProcedure = torn_with(kTray);
  return kProcedure;
}

const procedure::Procedure& inflamed() {
  static const procedure::Procedure kProcedure = inflamed_with(kTray);
  return kProcedure;
}

/// With the disc's middle on the tour, by which it is torn, and a second portal from the side.
const cases::CaseData& wrist_with_disc() {
  static const cases::CaseData data = [] {
    cases::ArthroscopicMap map = map_with_disc();
    cases::Portal beside = map.portals.front();
    beside.id = "6R";
    beside.skin = kMiddle + Vec3{0, kHalf + 6, 0};
    beside.inwards = {0, -1, 0};
    map.portals.push_back(beside);
    return box_wrist_with(std::move(map));
  }();
  return data;
}

const procedure::ShavingFacts& taken(const Hand& hand) { return hand.now().scope.facts.shaving; }
const procedure::PunchFacts& facts(const Hand& hand) { return hand.now().scope.facts.punch; }

/// Leads the open jaws so that their middle comes over a place of the floor.
void lay_jaws(Hand& hand, const Vec3& place, double over_mm = 1.0) {
  hand.drive(Driver::Reverse);
  const Vec3 middle = place + Vec3{0, 0, over_mm};
  const Vec3 skin = kMiddle + Vec3{kHalf + 6, 0, 0};
  const Vec3 tip = middle - normalized_or(skin - middle, {1, 0, 0}) * bite().behind_mm;
  hand.go(tip + Vec3{0, 0, 1.0});
  hand.go(tip, 100);
}

/// The middle of what hangs loose about the tear.
Vec3 tear() {
  static const Vec3 kAt = [] {
    Vec3 sum;
    int count = 0;
    const cases::JointLesions made =
        lesions_of(wrist_with_disc(), torn(), 1).value_or(cases::JointLesions{});
    for (const cases::TissuePiece& piece : made.pieces) {
      if (!piece.is_ill) continue;
      sum += piece.at;
      ++count;
    }
    return sum / count;
  }();
  return kAt;
}

void close(Hand& hand) { hand.drive(Driver::Forward); }

int gone(const Hand& hand) { return taken(hand).ill_removed + taken(hand).sound_removed; }

TEST(PunchInJoint, TakesWhatLiesBetweenItsJawsAtOnceAndNothingMoreUntilTheyWereOpened) {
  World world(wrist_with_disc(), torn(), 1);
  Hand hand(world);
  enter(hand);
  lay_jaws(hand, tear());
  ASSERT_EQ(gone(hand), 0);
  ASSERT_GE(taken(hand).ill, 10);
  close(hand);
  const int first = gone(hand);
  EXPECT_GE(first, 3) << "in the tick in which they closed";
  EXPECT_LE(first, 9) << "of as much as the bite is wide";
  EXPECT_GE(taken(hand).ill_removed, 3) << "at the tear";
  EXPECT_TRUE(hand.now().scope.are_closed[0]);
  EXPECT_EQ(facts(hand).bites, 1U);
  EXPECT_EQ(facts(hand).empty, 0U);
  hand.go(tear() + Vec3{2, 0, 1.0}, 300);
  EXPECT_EQ(gone(hand), first) << "led on closed";
  hand.drive(Driver::Off);
  hand.drive(Driver::Forward);
  EXPECT_EQ(facts(hand).bites, 1U) << "a hand that was not heard of did not open them";
  lay_jaws(hand, tear() + Vec3{2, 0, 0});
  EXPECT_FALSE(hand.now().scope.are_closed[0]);
  EXPECT_EQ(gone(hand), first) << "opened";
  close(hand);
  EXPECT_GT(gone(hand), first);
  EXPECT_EQ(facts(hand).bites, 2U);
}

TEST(PunchInJoint, WhatCameOffIsNoLongerInTheSheetAndOnThePage) {
  World world(wrist_with_disc(), torn(), 1);
  Hand hand(world);
  enter(hand);
  lay_jaws(hand, kFloor);
  close(hand);
  int none_left = 0;
  for (std::size_t i = 0; i < hand.now().scope.piece_count; ++i) {
    if (hand.now().scope.pieces_left[i] == 0) ++none_left;
    EXPECT_TRUE(hand.now().scope.pieces_left[i] == 0 || hand.now().scope.pieces_left[i] == 100);
  }
  EXPECT_EQ(none_left, gone(hand));
  // A probe goes deeper there than through the whole disc.
  const auto deep = [](Hand& led) {
    led.go(kMiddle);
    led.go(kMiddle + Vec3{40, 0, 0}, 50);
    led.command(test::take("hook_probe"));
    enter(led);
    led.go(kFloor + Vec3{0, 0, 1.5});
    led.go(kFloor - Vec3{0, 0, 1.5}, 50);
    return led.tip().z;
  };
  World whole(wrist_with_disc(), torn(), 1);
  Hand other(whole);
  EXPECT_LT(deep(hand), deep(other) - 0.3);
}

TEST(PunchInJoint, FarFromTheTearSoundDiscComesOffAndItIsTold) {
  World world(wrist_with_disc(), torn(), 1);
  Hand hand(world);
  enter(hand);
  lay_jaws(hand, kFloor + Vec3{-3.5, -3.5, 0});
  close(hand);
  EXPECT_EQ(taken(hand).ill_removed, 0);
  EXPECT_GE(taken(hand).sound_removed, 3);
  EXPECT_GE(taken(hand).rim_removed, 1) << "2 mm of the held edge";
  EXPECT_EQ(facts(hand).empty, 0U);
  int told = 0;
  for (std::size_t i = 0; i < hand.now().event_count; ++i) {
    if (hand.now().events[i].kind != EventKind::SoundTissueShaved) continue;
    ++told;
    EXPECT_EQ(hand.now().events[i].detail, 1) << "of the rim";
  }
  EXPECT_EQ(told, 1) << "a bite is told once";
}

TEST(PunchInJoint, BitesOnNothingAndOnLiningAreCountedApartAndOutsideNone) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  hand.drive(Driver::Reverse);
  close(hand);
  EXPECT_TRUE(hand.now().scope.are_closed[0]);
  EXPECT_EQ(facts(hand).bites, 0U) << "in the room";
  enter(hand);
  EXPECT_EQ(facts(hand).bites, 0U) << "it came in closed";
  hand.drive(Driver::Reverse);
  close(hand);
  EXPECT_EQ(facts(hand), (procedure::PunchFacts{1, 1, 1, 0, 0})) << "amid the joint, unseen";
  EXPECT_FALSE(test::has_event(hand.now(), EventKind::TissueBitten));
  lay_jaws(hand, kFloor + Vec3{-6, -8, 0}, 0.5);
  close(hand);
  EXPECT_EQ(facts(hand), (procedure::PunchFacts{2, 2, 1, 0, 1}));
  EXPECT_TRUE(test::has_event(hand.now(), EventKind::TissueBitten));
  EXPECT_EQ(gone(hand), 0);
  EXPECT_EQ(hand.now().scope.scuff_count, 0);
}

TEST(PunchInJoint, TuftsAboutTheNearestComeOffTogether) {
  World world(box_wrist(), inflamed(), 1);
  Hand hand(world);
  const auto lesions = lesions_of(box_wrist(), inflamed(), 1);
  const Vec3 tuft = lesions->pieces.front().at;
  enter(hand);
  lay_jaws(hand, tuft);
  close(hand);
  int within = 0;
  for (std::size_t i = 0; i < lesions->pieces.size(); ++i) {
    if (hand.now().scope.pieces_left[i] == 0) ++within;
  }
  EXPECT_GE(within, 1);
  EXPECT_EQ(taken(hand).ill_removed, within);
  for (std::size_t i = 0; i < lesions->pieces.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (hand.now().scope.pieces_left[i] != 0 || hand.now().scope.pieces_left[k] != 0) continue;
      EXPECT_LE(distance(lesions->pieces[i].at, lesions->pieces[k].at), bite().width_mm);
    }
  }
}

TEST(PunchInJoint, TakenIntoTheHandAmidTheJointItBitesNothing) {
  World world(wrist_with_disc(), torn(), 1);
  Hand hand(world);
  hand.command(test::take("shaver_2_0"));
  enter(hand);
  hand.go(kFloor + Vec3{0, 0, 1.0}, 50);
  hand.drive(Driver::Forward);
  const int before = gone(hand);
  hand.command(test::take("punch_2_0"));
  for (int i = 0; i < 200; ++i) hand.step();
  EXPECT_EQ(facts(hand).bites, 0U) << "the pedal of what it held before closes no jaws in a joint";
  EXPECT_EQ(gone(hand), before);
}

TEST(PunchInJoint, ABiteCountsAsSeenWhileTheScopeShowsTheJaws) {
  World world(wrist_with_disc(), torn(), 1);
  Hand hand(world);
  enter(hand);
  lay_jaws(hand, kFloor);
  Input input = hand.inputs.back();
  input.command = test::take("arthroscope_1_9_30", 1);
  input.hands[1].shaft_in_patient = {0, 1, 0};
  input.hands[1].tip_in_patient = kMiddle + Vec3{0, 40, 0};
  world.step(input);
  input.command = {};
  input.command.kind = CommandKind::TurnScope;
  input.command.rotation_deg = 180;
  world.step(input);
  input.command = {};
  for (const Vec3& next : {kMiddle + Vec3{0, kHalf - 1, 0}, kMiddle + Vec3{0, 7, 1}}) {
    const Vec3 from = input.hands[1].tip_in_patient;
    constexpr int kTicks = 1500;
    for (int i = 1; i <= kTicks; ++i) {
      input.hands[1].tip_in_patient = from + (next - from) * (static_cast<double>(i) / kTicks);
      world.step(input);
    }
  }
  ASSERT_TRUE(world.now().scope.facts.is_in_joint[1]);
  const procedure::PunchFacts& done = world.now().scope.facts.punch;
  input.hands[0].driver = Driver::Forward;
  world.step(input);
  EXPECT_EQ(done, (procedure::PunchFacts{1, 0, 0, 0, 0}));
  input.hands[0].driver = Driver::Reverse;
  world.step(input);
  input.command.kind = CommandKind::TurnScope;
  input.command.rotation_deg = 0;  // to the ceiling
  world.step(input);
  input.command = {};
  input.hands[0].driver = Driver::Forward;
  world.step(input);
  EXPECT_EQ(done.bites, 2U);
  EXPECT_EQ(done.unseen, 1U);
}

/// With the lunate's lowest place 2.5 mm over the disc, over its middle.
cases::CaseData with_lunate() {
  cases::CaseData data = wrist_with_disc();
  cases::Bone& lunate = data.bones[test::body_of(BoneId::Lunate)];
  Vec3 lowest = lunate.surface.vertices.front();
  for (const Vec3& v : lunate.surface.vertices) lowest = v.z < lowest.z ? v : lowest;
  const Vec3 by = kFloor + Vec3{0, 0, 2.5} - lowest;
  for (Vec3& v : lunate.surface.vertices) v += by;
  GridGeometry geometry = lunate.distance_field.geometry();
  geometry.origin = geometry.origin + by;
  lunate.distance_field = {geometry, std::vector<float>(lunate.distance_field.values().begin(),
                                                        lunate.distance_field.values().end())};
  return data;
}

TEST(PunchInJoint, CartilageThatLiesNearerThanTheDiscIsScuffedWhereItWasBitten) {
  const cases::CaseData data = with_lunate();
  for (const double over_mm : {1.5, 0.9}) {
    World world(data, torn(), 1);
    Hand hand(world);
    enter(hand);
    lay_jaws(hand, kFloor, over_mm);
    close(hand);
    ASSERT_EQ(facts(hand).bites, 1U);
    if (over_mm < 1.0) {
      EXPECT_EQ(facts(hand).cartilage, 0U) << "the disc is nearer";
      EXPECT_GT(gone(hand), 0);
      continue;
    }
    EXPECT_EQ(facts(hand).cartilage, 1U);
    EXPECT_EQ(gone(hand), 0) << "the disc is left alone";
    EXPECT_TRUE(test::has_event(hand.now(), EventKind::TissueBitten));
    ASSERT_EQ(hand.now().scope.scuff_count, 1);
    const Vec3 at = hand.now().scope.scuffs[0].at_as_scanned;
    EXPECT_NEAR(distance(at, kFloor + Vec3{0, 0, 2.5}), 0.0, 0.4) << at.x << ' ' << at.z;
    const auto told = world.operation_record().scope->scuff_places;
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].body, test::body_of(BoneId::Lunate));
    EXPECT_EQ(told[0].at, at);
    EXPECT_EQ(told[0].how, procedure::Scuffing::Bitten);
  }
}

TEST(PunchInJoint, GoesOnFromAKeyframeToTheSameBits) {
  World world(wrist_with_disc(), torn(), 1);
  Hand hand(world);
  enter(hand);
  lay_jaws(hand, kFloor);
  close(hand);
  ASSERT_GE(gone(hand), 1);
  World again(wrist_with_disc(), torn(), 1);
  const auto read = again.read_state(world.write_state());
  ASSERT_TRUE(read.has_value()) << read.error();
  EXPECT_EQ(again.write_state(), world.write_state());
  Input on = hand.inputs.back();
  for (int i = 0; i < 900; ++i) {
    on.hands[0].tip_in_patient += Vec3{-0.002, 0, 0};
    on.hands[0].driver = i % 300 < 150 ? Driver::Reverse : Driver::Forward;
    world.step(on);
    again.step(on);
    ASSERT_EQ(again.now().state_hash, world.now().state_hash) << i;
  }
  EXPECT_GE(facts(hand).bites, 3U);
  EXPECT_EQ(again.now().scope, world.now().scope);
}

TEST(PunchInJoint, NoTickAllocatesWhileItBites) {
  World first(wrist_with_disc(), torn(), 1);
  Hand hand(first);
  enter(hand);
  for (const double x : {0.0, 1.5, -1.5}) {
    lay_jaws(hand, kFloor + Vec3{x, 0, 0});
    close(hand);
  }
  ASSERT_EQ(facts(hand).bites, 3U);
  ASSERT_GT(gone(hand), 5);
  World world(wrist_with_disc(), torn(), 1);
  carpus::test::start_counting_allocations();
  for (const Input& each : hand.inputs) world.step(each);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(world.now().state_hash, first.now().state_hash);
}

TEST(PunchInJoint, IsPartOfNoStateWhereNoneLiesOnTheTray) {
  procedure::Procedure without = torn();
  without.tray.erase(without.tray.begin());
  World with(wrist_with_disc(), torn(), 1);
  World other(wrist_with_disc(), without, 1);
  EXPECT_GT(with.write_state().size(), other.write_state().size());
}

}  // namespace
}  // namespace carpus::simulation
