// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A ligament that yields, in a box of a joint whose ceiling it is: what a probe feels of its
// grades.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "simulation/box_joint_test_support.hpp"
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

constexpr std::size_t kLigament = 1;
const Vec3 kUnderIt = kMiddle + Vec3{0.5, 0.4, 0};

const procedure::Procedure& examination() {
  static const procedure::Procedure kExamination = probing(true);
  return kExamination;
}

/// A seed by which the scapholunate ligament has this grade.
std::uint64_t seed_of(std::size_t grade) {
  const auto& table = arthroscopy::PathologyTable::generic();
  for (std::uint64_t seed = 1; seed < 10'000; ++seed) {
    if (arthroscopy::grades_by(seed, table)[0] == grade) return seed;
  }
  ADD_FAILURE() << "no seed has grade " << grade;
  return 0;
}

double most_off(const Snapshot& now) {
  double most = 0;
  for (std::size_t i = 0; i < now.sheets[kLigament].count; ++i) {
    most = std::max(most, static_cast<double>(now.sheets[kLigament].off[i][2]));
  }
  return most;
}

/// How far the tip goes from the first touch until so much is felt.
double felt_depth_mm(std::size_t grade, double newtons) {
  World world(box_wrist_with_ligament(), examination(), seed_of(grade));
  EXPECT_EQ(world.lesions()->grades[0], grade);
  Hand hand(world);
  enter(hand);
  hand.go(kUnderIt, 500);
  double touched = 0;
  for (double up = 0; up < 8; up += 0.02) {
    hand.go(kUnderIt + Vec3{0, 0, up}, 20);
    const double felt = -hand.now().hands[0].force_in_patient.z;
    if (felt < 0.03) touched = hand.tip().z;
    if (felt >= newtons) return hand.tip().z - touched;
  }
  ADD_FAILURE() << "nothing is felt at grade " << grade;
  return 0;
}

TEST(YieldingSheets, ALigamentYieldsToThePressBearsItAndComesBack) {
  World world(box_wrist_with_ligament(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  ASSERT_EQ(hand.now().sheet_count, 2);
  ASSERT_GT(hand.now().sheets[kLigament].count, 60);
  hand.go(kUnderIt + Vec3{0, 0, 4}, 800);
  EXPECT_FALSE(hand.now().sheets[kLigament].is_still);
  EXPECT_TRUE(hand.now().sheets[0].is_still) << "the disc sleeps";
  // The shaft lies along the ceiling: the round tip touches it half a millimetre below.
  const double deep = hand.tip().z + 0.5 - (kMiddle.z + kHalfHigh);
  EXPECT_GT(deep, 0.2);
  EXPECT_LT(deep, 0.9) << "taut";
  EXPECT_GT(most_off(hand.now()), 0.1);
  hand.go(kMiddle, 2000);
  EXPECT_TRUE(hand.now().sheets[kLigament].is_still) << "at rest within 2 s";
  EXPECT_EQ(most_off(hand.now()), 0);
}

/// What Geissler's grades feel like to a probe, whatever of them shows.
TEST(YieldingSheets, APressTellsAWholeLigamentFromOneThatIsAttenuated) {
  const double whole = felt_depth_mm(0, 1.0);
  const double first = felt_depth_mm(1, 1.0);
  const double second = felt_depth_mm(2, 1.0);
  EXPECT_LT(whole, 0.5);
  EXPECT_GT(first, 1.5 * whole);
  EXPECT_GT(second, 1.15 * first);
  EXPECT_LT(second, 2.0);
}

TEST(YieldingSheets, ATornOneLetsTheProbeThroughAndNoOtherDoes) {
  const auto highest = [](std::size_t grade) {
    World world(box_wrist_with_ligament(), examination(), seed_of(grade));
    const auto& lesions = world.lesions()->lesions;
    Vec3 at = kUnderIt;
    for (const cases::Lesion& lesion : lesions) {
      if (lesion.finding == 0) at = (lesion.from + lesion.to) * 0.5;
    }
    Hand hand(world);
    enter(hand);
    hand.go({at.x, at.y, kMiddle.z}, 200);
    hand.go({at.x, at.y, kMiddle.z + kHalfHigh + 3}, 400);
    return hand.tip().z - kMiddle.z - kHalfHigh;
  };
  EXPECT_GT(highest(3), 2.5);
  EXPECT_LT(highest(2), 2.0);
  EXPECT_LT(highest(0), 0.8);
}

/// A recess beside a ligament is deeper than it: who is in there lies on no sheet.
TEST(YieldingSheets, ATipThatPassesDeepBesideASheetIsNotHeldByIt) {
  cases::CaseData data = box_wrist_with_ligament();
  cases::ArthroscopicMap map = *data.arthroscopy;
  for (Vec3& at : map.bands.front().at) at.z -= 3.0;  // the ceiling is far above it
  data.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(std::move(map));
  World world(data, probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  const double beside = 4.0;  // a millimetre and a half of its rim
  hand.go(kMiddle + Vec3{9, 0, 0});
  hand.go(kMiddle + Vec3{9, beside, 2.5}, 100);
  const Vec3 there = kMiddle + Vec3{-9, beside, 2.5};
  hand.go(there, 100);
  EXPECT_LT(distance(hand.tip(), there), 0.05);
  EXPECT_LT(length(hand.now().hands[0].force_in_patient), 0.1);
  EXPECT_TRUE(hand.now().sheets[kLigament].is_still);
}

TEST(YieldingSheets, GoesOnFromAKeyframeInThePressOfALigamentToTheSameBits) {
  World world(box_wrist_with_ligament(), probe_alone(), 1);
  Hand hand(world);
  enter(hand);
  hand.go(kUnderIt + Vec3{0, 0, 4}, 100);
  ASSERT_FALSE(hand.now().sheets[kLigament].is_still);
  World other(box_wrist_with_ligament(), probe_alone(), 1);
  ASSERT_TRUE(other.read_state(world.write_state()));
  EXPECT_EQ(other.now().sheets[kLigament].off, world.now().sheets[kLigament].off);
  Input input = hand.inputs.back();
  for (int i = 0; i < 300; ++i) {
    input.hands[0].tip_in_patient.z -= 0.01;
    input.wrist.flexion_rad = 0.001 * i;
    const std::uint64_t expected = world.step(input).state_hash;
    ASSERT_EQ(other.step(input).state_hash, expected) << "tick " << i;
  }
}

TEST(YieldingSheets, ALigamentGoesWithBothOfItsBones) {
  World world(box_wrist_with_ligament(), probe_alone(), 1);
  Input input;
  input.hands[0].tip_in_patient = kMiddle + Vec3{40, 0, 0};
  input.hands[0].shaft_in_patient = {1, 0, 0};
  input.hands[1] = input.hands[0];
  input.wrist.flexion_rad = 0.4;
  for (int i = 0; i < 3000; ++i) world.step(input);
  const cases::LigamentBand& band = box_wrist_with_ligament().arthroscopy->bands.front();
  const auto& poses = world.now().patient_from_bone;
  const SheetView& view = world.now().sheets[kLigament];
  EXPECT_TRUE(view.is_still) << "bones that move wake nothing";
  // The end of a fibre lies where the second bone has it.
  const std::size_t end = 3 * band.columns - 1;
  const Vec3 off{static_cast<double>(view.off[end][0]), static_cast<double>(view.off[end][1]),
                 static_cast<double>(view.off[end][2])};
  const Vec3 first = (poses[band.first] * Point<frame::Bone>{band.at[end] + off}).v;
  const Vec3 second = (poses[band.second] * Point<frame::Bone>{band.at[end]}).v;
  EXPECT_LT(distance(first, second), 1e-5);
  EXPECT_GT(length(off), 0.1) << "bending has parted them";
}

TEST(YieldingSheets, NoTickAllocatesWhileDiscAndLigamentArePressedInTurn) {
  World first(box_wrist_with_ligament(), probe_alone(), 1);
  Hand hand(first);
  enter(hand);
  hand.go(kUnderIt + Vec3{0, 0, 4}, 100);
  hand.go(kUnderIt + Vec3{0, 0, -4.5}, 200);
  EXPECT_FALSE(hand.now().sheets[0].is_still);
  hand.go(kMiddle, 200);
  World world(box_wrist_with_ligament(), probe_alone(), 1);
  carpus::test::start_counting_allocations();
  for (const Input& input : hand.inputs) world.step(input);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(world.now().state_hash, first.now().state_hash);
}

}  // namespace
}  // namespace carpus::simulation
