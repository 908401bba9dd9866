// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whatever the instrument, the bone and the wrist do, the hand never gets back more work than it
// put in and the coupling's first store.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "haptics/virtual_coupling.hpp"
#include "simulation/muscle_hand_test_support.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation {
namespace {

class Passivity : public testing::TestWithParam<std::string> {};

TEST_P(Passivity, TheHandNeverGetsBackMoreThanItPutIn) {
  double most_put_in = 0;
  for (std::uint64_t seed = 1; seed <= carpus::test::amount<std::uint64_t>(1, 4, 40); ++seed) {
    Rng rng(seed);
    test::Operator op;
    const instruments::Instrument& kind = instruments::catalogue()[test::instrument(GetParam())];
    if (kind.bore_radius_mm > 0 && !kind.is_sleeve) {  // it needs a wire to ride on
      op.place_on_entry({});
      op.drive_to(15.0);
      op.command(test::take(GetParam()));
    } else {
      op.command(test::take(GetParam()));
      op.place_on_entry({});
    }
    ASSERT_EQ(op.item().instrument, test::instrument(GetParam()));
    test::MuscleHand hand{op.item().tip_in_patient, {}};
    op.hand().tip_in_patient = hand.place;
    op.hold(Driver::Off, 0, 3);
    Vec3 wanted = hand.place;
    Vec3 last = hand.place;
    double work = 0;  // on the hand [N mm]
    Vec3 force = op.now().hands[0].force_in_patient;
    for (int tick = 0; tick < 6000; ++tick) {
      if (tick % 150 == 0) {
        wanted = op.entry() + Vec3{rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-4, 4)};
        op.hand().driver = static_cast<Driver>(rng.below(3));
        op.hand().thrust_n = rng.uniform(0, 40);
      }
      hand.step(wanted, force);
      op.hand().tip_in_patient = hand.place;
      op.step();
      work += dot(force, test::as_given(hand.place) - test::as_given(last));
      last = hand.place;
      most_put_in = std::min(most_put_in, work);
      ASSERT_LE(work, haptics::kFirstStoredNMm + 1e-9) << "seed " << seed << " tick " << tick;
      if (op.now().hands[0].item == kNoItem) break;  // it came out and off
      force = op.now().hands[0].force_in_patient;
    }
  }
  EXPECT_LT(most_put_in, -0.05) << "the hand did work against it";
}

INSTANTIATE_TEST_SUITE_P(Instruments,
                         Passivity,
                         testing::Values("guide_wire",
                                         "joystick_wire",
                                         "needle_sleeve_14g",
                                         "depth_gauge",
                                         "cannulated_drill",
                                         "acutrak_standard_1994_20",
                                         "acutrak_2_mini_24",
                                         "probe"));

}  // namespace
}  // namespace carpus::simulation
