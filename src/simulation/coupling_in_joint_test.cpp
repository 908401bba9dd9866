// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In a joint walls and tissue move a tip by themselves: the hand that holds it always feels again,
// and gets back no more than it put in and a first store for each time that nothing held it.
#include <gtest/gtest.h>

#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "haptics/virtual_coupling.hpp"
#include "simulation/box_joint_test_support.hpp"
#include "simulation/muscle_hand_test_support.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;

constexpr double kDeepMm = 1.5;

/// The force that a press into the box's wall is felt with [N].
double felt_at_the_wall(Hand& hand) {
  hand.go(kMiddle, 50);
  hand.go(kMiddle + Vec3{-kHalf - kDeepMm, 0, 0}, 50);
  return length(hand.now().hands[0].force_in_patient);
}

TEST(CouplingInJoint, TheWallIsFeltAgainWhateverWasStroked) {
  for (std::uint64_t seed = 1; seed <= carpus::test::amount<std::uint64_t>(1, 2, 60); ++seed) {
    World world(box_wrist_with_ligament(), probe_alone(), seed);
    Hand hand(world);
    enter(hand);
    Rng rng(seed);
    for (int stroke = 1; stroke <= 20; ++stroke) {
      hand.mm_per_tick = rng.uniform(0.005, 0.1);
      hand.go(kMiddle + Vec3{rng.uniform(-14, 8), rng.uniform(-7, 7), rng.uniform(-7, 7)});
      if (stroke % 5 != 0) continue;
      hand.mm_per_tick = 0.02;
      ASSERT_GT(felt_at_the_wall(hand), 1.0) << "seed " << seed << " stroke " << stroke;
    }
  }
}

TEST(CouplingInJoint, GivesBackNoMoreThanWasPutInAndAFirstStoreForEachLettingGo) {
  for (std::uint64_t seed = 1; seed <= carpus::test::amount<std::uint64_t>(1, 2, 60); ++seed) {
    World world(box_wrist_with_ligament(), probe_alone(), seed);
    Hand hand(world);
    enter(hand);
    Rng rng(seed);
    test::MuscleHand muscle{kMiddle, {}};
    Vec3 wanted = kMiddle;
    Vec3 last = kMiddle;
    Vec3 force = hand.now().hands[0].force_in_patient;
    double work = 0;  // on the hand [N mm]
    double most_put_in = 0;
    double may = haptics::kFirstStoredNMm;
    bool was_held = false;
    for (int tick = 0; tick < 8000; ++tick) {
      if (tick % 150 == 0) {
        wanted = kMiddle + Vec3{rng.uniform(-14, 8), rng.uniform(-7, 7), rng.uniform(-6, 6)};
      }
      muscle.step(wanted, force);
      hand.lead(muscle.place);
      work += dot(force, test::as_given(muscle.place) - test::as_given(last));
      last = muscle.place;
      most_put_in = std::min(most_put_in, work);
      ASSERT_LE(work, may + 1e-9) << "seed " << seed << " tick " << tick;
      force = hand.now().hands[0].force_in_patient;
      const bool is_held = distance(hand.tip(), test::as_given(muscle.place)) > 0;
      if (was_held && !is_held) may += haptics::kFirstStoredNMm;
      was_held = is_held;
    }
    EXPECT_LT(most_put_in, -0.05) << "the hand did work against it";
  }
}

}  // namespace
}  // namespace carpus::simulation
