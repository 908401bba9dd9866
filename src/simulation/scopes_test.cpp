// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes into joints, in a box of a joint far from the bones: portals, the disc that yields and
// can be hooked, answers, keyframes, no allocation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arthroscopy/pathology_table.hpp"
#include "core/error.hpp"
#include "simulation/box_joint_test_support.hpp"
#include "simulation/detail/scope_watch.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::test {
// Defined once in this program, where allocation_guard_test.cpp includes it.
void start_counting_allocations() noexcept;
int stop_counting_allocations() noexcept;
}  // namespace carpus::test

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

/// By how much the particle that moved farthest distally, or proximally (negative), is off.
double most_off(const Snapshot& now, double sign) {
  double most = 0;
  for (std::size_t i = 0; i < now.sheets[0].count; ++i) {
    most = std::max(most, sign * static_cast<double>(now.sheets[0].off[i][2]));
  }
  return most;
}

TEST(Scopes, ATipEntersByThePortalAndTheWallHoldsItWhereThereIsNoDisc) {
  World world(box_wrist(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  ASSERT_TRUE(hand.now().scope.facts.is_in_joint[0]);
  hand.go(kMiddle + Vec3{-9, 0, 0});
  hand.go(kMiddle + Vec3{-9, 0, -5}, 300);
  EXPECT_NEAR(hand.tip().z, -kHalfHigh - 0.3, 0.15) << "the rigid wall, beside the disc";
  EXPECT_TRUE(hand.now().sheets[0].is_still);
}

procedure::Procedure drilling(std::vector<std::uint8_t> places) {
  procedure::Procedure made = probe_alone();
  made.drill.emplace();
  made.drill->hold = made.drill->touch = places;
  made.drill->line = std::move(places);
  made.drill->hold_s = 3;
  made.drill->touch_mm = made.drill->line_mm = 2.5;
  return made;
}

TEST(Scopes, AnExerciseGoesOnFromAKeyframeAsItWas) {
  const procedure::Procedure exercise = drilling({16, 16});
  World world(box_wrist(), exercise, 1);
  Hand hand(world);
  enter(hand);
  hand.go(kEdge);
  const procedure::DrillFacts before = hand.now().scope.facts.drill;
  EXPECT_GT(before.unseen_path_mm, 1.0) << "no scope sees it";
  EXPECT_EQ(before.touched, 0);
  World again(box_wrist(), exercise, 1);
  ASSERT_TRUE(again.read_state(world.write_state()).has_value());
  EXPECT_EQ(again.now().scope.facts.drill, before);
  const simulation::Input still{};
  EXPECT_EQ(again.step(still).state_hash, world.step(still).state_hash);
}

TEST(Scopes, AnExerciseAtAPlaceThatTheWristLacksIsRefusedByItsNumber) {
  const procedure::Procedure exercise = drilling({16, 31});
  try {
    const World world(box_wrist(), exercise, 1);
    FAIL() << "it began";
  } catch (const InvalidInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("31"), std::string::npos) << problem.what();
  }
}

/// A tube across the way in, 4 mm under the skin and so far beside the way.
cases::CaseData wrist_with_tube(anatomy::StructureKind kind, double beside_mm) {
  cases::CaseData data = box_wrist();
  cases::Structure tube{"tube", "a tube", kind, 1.0, BoneId::Radius, {}};
  for (int i = -20; i <= 20; ++i) {
    tube.course.push_back({kMiddle + Vec3{kHalf + 2, beside_mm, static_cast<double>(i)}, 0.0});
  }
  data.structures = {tube};
  return data;
}

/// @param leant  sideways, of the way that is marked for the portal
procedure::NearStructure after_entering(anatomy::StructureKind kind,
                                        double beside_mm,
                                        double leant = -0.34) {
  cases::CaseData data = wrist_with_tube(kind, beside_mm);
  cases::ArthroscopicMap map = *data.arthroscopy;
  for (cases::Portal& portal : map.portals) {
    portal.inwards = normalized_or(portal.inwards + Vec3{0, leant, 0}, portal.inwards);
    portal.capsule_mm *= std::hypot(1.0, leant);
  }
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(std::move(map));
  World world(data, probe_alone(), 1);
  Hand hand(world);
  hand.go(kMiddle + Vec3{kHalf + 1, 0, 0});
  EXPECT_FALSE(world.operation_record().structures[0].was_struck) << "it is not in the joint yet";
  hand.go(kMiddle);
  EXPECT_TRUE(hand.now().scope.facts.is_in_joint[0]);
  return world.operation_record().structures[0];
}

TEST(Scopes, AWayInStrikesANerveThatItTouchesAndATendonThroughItsMiddleAlone) {
  using anatomy::StructureKind;
  const InstrumentIndex probe = *instruments::instrument_of("hook_probe");
  const double radius_mm = instruments::catalogue()[probe].shape.greatest_radius_mm();
  const auto beside = after_entering(StructureKind::Nerve, 4.0);
  EXPECT_FALSE(beside.was_struck);
  EXPECT_NEAR(beside.least_mm, 4.0 - 1.0 - radius_mm, 0.1);
  EXPECT_EQ(beside.by, probe);
  EXPECT_TRUE(after_entering(StructureKind::Nerve, 1.2).was_struck);
  EXPECT_TRUE(after_entering(StructureKind::Artery, 1.2).was_struck);
  const auto spread = after_entering(StructureKind::Tendon, 1.2);
  EXPECT_FALSE(spread.was_struck) << "pushed aside";
  EXPECT_LT(spread.least_mm, 0);
  EXPECT_TRUE(after_entering(StructureKind::Tendon, 0.2).was_struck);
  EXPECT_FALSE(after_entering(StructureKind::Tendon, 0.2, 0.0).was_struck)
      << "the marked way itself goes there";
}

TEST(Scopes, AnInstrumentInAJointByNoPortalIsNoStateThatATickLeft) {
  detail::ScopeState state;
  EXPECT_TRUE(detail::is_possible(state, 2));
  state.is_in_joint[1] = true;
  EXPECT_FALSE(detail::is_possible(state, 2));
  state.portal[1] = 1;
  EXPECT_TRUE(detail::is_possible(state, 2));
}

TEST(Scopes, TheDiscYieldsToThePressAndComesBack) {
  World world(box_wrist(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  hand.go(kMiddle + Vec3{0, 0, -4.5}, 800);
  const double deep = -kHalfHigh - hand.tip().z;
  EXPECT_GT(deep, 0.4) << "deeper than the rigid wall";
  EXPECT_LT(deep, 1.5);
  EXPECT_GT(most_off(hand.now(), -1), 0.2);
  const double force = length(hand.now().hands[0].force_in_patient);
  EXPECT_GT(force, 0.1);
  EXPECT_LT(force, 5);
  hand.go(kMiddle, 2000);
  EXPECT_TRUE(hand.now().sheets[0].is_still) << "at rest within 2 s";
  EXPECT_EQ(most_off(hand.now(), -1), 0);
}

TEST(Scopes, AHookThatTouchedTheEdgeTakesItAlongUntilItSlips) {
  World world(box_wrist(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  hand.go(kEdge + Vec3{0, 0, 2});
  hand.go(kEdge + Vec3{0, 0, -1.0}, 400);
  double lifted = 0;
  double pulled = 0;
  for (double up = -0.9; up < 4; up += 0.1) {
    hand.go(kEdge + Vec3{0, 0, up}, 40);
    lifted = std::max(lifted, most_off(hand.now(), 1));
    pulled = std::max(pulled, -hand.now().hands[0].force_in_patient.z);
  }
  EXPECT_GT(lifted, 0.3) << "it followed";
  EXPECT_GT(pulled, 0.5) << "and pulled back";
  EXPECT_LT(pulled, 6.0);
  hand.go(kMiddle, 2500);
  EXPECT_TRUE(hand.now().sheets[0].is_still) << "it slipped off";
}

TEST(Scopes, GoesOnFromAKeyframeInThePressToTheSameBits) {
  World world(box_wrist(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  hand.go(kMiddle + Vec3{0.3, 0.2, -4.2}, 100);
  ASSERT_FALSE(hand.now().sheets[0].is_still);
  World other(box_wrist(), probe_alone(), 1);
  ASSERT_TRUE(other.read_state(world.write_state()));
  Hand same(other);
  Input input = hand.inputs.back();
  for (int i = 0; i < 300; ++i) {
    input.hands[0].tip_in_patient.z += 0.01;
    const std::uint64_t expected = world.step(input).state_hash;
    ASSERT_EQ(other.step(input).state_hash, expected) << "tick " << i;
  }
}

TEST(Scopes, NoTickAllocatesWhileTheDiscYields) {
  World first(box_wrist(), probe_alone(), 1);
  Hand hand(first);
  enter(hand);
  hand.go(kEdge + Vec3{0, 0, -1.0}, 200);
  hand.go(kEdge + Vec3{0, 0, 2}, 200);
  World world(box_wrist(), probe_alone(), 1);
  carpus::test::start_counting_allocations();
  for (const Input& input : hand.inputs) world.step(input);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(world.now().state_hash, first.now().state_hash);
}

TEST(Scopes, AnswersOfAnExaminationAreKeptAndCanBeTakenBack) {
  static const procedure::Procedure kExamination = probing(true);
  World world(box_wrist(), kExamination, 1);
  Hand hand(world);
  Command answer;
  answer.kind = CommandKind::Answer;
  answer.index = answer_index(2, 3);
  hand.command(answer);
  EXPECT_EQ(hand.now().scope.answers[2], 3);
  answer.index = answer_index(2, 1);
  hand.command(answer);
  EXPECT_EQ(hand.now().scope.answers[2], 1) << "the newest counts";
  answer.index = answer_index(2, kNoGrade);
  hand.command(answer);
  EXPECT_EQ(hand.now().scope.answers[2], cases::kNotJudged);
  // What is not asked, and grades that are none.
  const auto asked = arthroscopy::PathologyTable::generic().findings.size();
  answer.index = answer_index(asked, 0);
  EXPECT_NE(why_not(kExamination, hand.now(), answer), Refusal::None);
  answer.index = answer_index(9, 2);
  EXPECT_NE(why_not(kExamination, hand.now(), answer), Refusal::None);
  answer.index = answer_index(9, 1);
  EXPECT_EQ(why_not(kExamination, hand.now(), answer), Refusal::None);
  EXPECT_NE(why_not(probe_alone(), hand.now(), answer), Refusal::None) << "nothing is asked";
  EXPECT_EQ(world.operation_record().scope->answers, cases::not_judged());
}

TEST(Scopes, AnswersAboutAScrewKeepWhatWasKnownWhenTheyWereGiven) {
  static const procedure::Procedure kControl = [] {
    procedure::Procedure made = probing(false);
    made.controls_screw = true;
    return made;
  }();
  World world(box_wrist(), kControl, 1);
  Hand hand(world);
  Command answer;
  answer.kind = CommandKind::Answer;
  answer.index = answer_index(0, 2);
  hand.command(answer);
  EXPECT_EQ(hand.now().scope.answers[0], 2);
  EXPECT_EQ(hand.now().scope.facts.screw.answered_seen, 0) << "nothing had been in view";
  answer.index = answer_index(3, 3);
  EXPECT_NE(why_not(kControl, hand.now(), answer), Refusal::None) << "there are three decisions";
  answer.index = answer_index(4, 0);
  EXPECT_NE(why_not(kControl, hand.now(), answer), Refusal::None) << "four things are asked";
  World other(box_wrist(), kControl, 1);
  ASSERT_TRUE(other.read_state(world.write_state()));
  Hand same(other);
  const Input input = hand.inputs.back();
  EXPECT_EQ(other.step(input).state_hash, world.step(input).state_hash);
}

}  // namespace
}  // namespace carpus::simulation
