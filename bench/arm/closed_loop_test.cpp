// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From hand to hand through the program that is flashed: host, frames, ATmega328P, servos, slots,
// delta, hand. src/device_bench has the same with the core compiled for the host, and more of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/arm/avr_board.hpp"
#include "device_bench/measures.hpp"
#include "device_bench/our_rig.hpp"

namespace carpus::bench {
namespace {

using device_bench::OurRig;
using device_bench::Press;
using device_bench::RigOptions;
using device_bench::Strike;

RigOptions with_hand(std::size_t hand) {
  RigOptions options;
  options.drive = firmware::Drive::Stop;
  options.hand = virtual_arm::kHandModels[hand];
  options.board = [] { return std::make_unique<AvrBoard>(CARPUS_ARM_AVR_ELF); };
  return options;
}

TEST(ClosedLoop, EveryHandStandsStillOnAHardWall) {
  for (std::size_t hand = 0; hand < virtual_arm::kHandModels.size(); ++hand) {
    OurRig rig(with_hand(hand));
    const Press pressed = press(rig);
    EXPECT_TRUE(pressed.has_reached);
    EXPECT_TRUE(pressed.is_still(rig.quantum_mm())) << pressed.to_and_fro_mm;
    if (rig.options().hand.stiffness_n_per_mm > 0) {
      EXPECT_LE(pressed.depth_mm, 1.1);
    }
  }
}

/// Along x one leg bears most: the worst of all ways.
TEST(ClosedLoop, PressedFromBesideItYieldsNoMoreThanIsAllowed) {
  double worst = 0;
  for (const std::size_t hand : {0U, 3U}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      RigOptions options = with_hand(hand);
      options.seed = seed;
      options.normal = {1, 0, 0};
      OurRig rig(options);
      const Press pressed = press(rig);
      std::printf("from beside, %s, specimen %d: %.2f mm at %.2f N\n",
                  std::string(options.hand.name).c_str(), static_cast<int>(seed), pressed.depth_mm,
                  pressed.force_n);
      EXPECT_TRUE(pressed.is_still(rig.quantum_mm())) << pressed.to_and_fro_mm;
      worst = std::max(worst, pressed.depth_mm);
    }
  }
  EXPECT_LE(worst, 1.1);
}

TEST(ClosedLoop, AWallGivesNoMoreBackThanItGotAndDoesNotHold) {
  for (const double speed : {50.0, 500.0}) {
    OurRig rig(with_hand(1));
    const Strike struck = strike(rig, speed);
    EXPECT_LE(struck.most_given_mj, 0.5);
    EXPECT_LE(struck.pulled_back_n, 0.05);
  }
}

TEST(ClosedLoop, IsNotFeltInFreeSpace) {
  OurRig rig(with_hand(2));
  EXPECT_LE(free_space_n(rig), 0.2);
}

TEST(ClosedLoop, ABadLineAndASilentHostAreBorne) {
  OurRig rig(with_hand(2));
  for (int ms = 0; ms < 300; ++ms) rig.run_ms();
  rig.plant().set_intent({rig.start() - Vec3{0, 0, 15}, {}});
  for (int ms = 0; ms < 400; ++ms) rig.run_ms();
  const double before = rig.felt_along_n();
  EXPECT_NEAR(before, 2.0, 0.6);
  rig.faults.corrupt = rig.faults.lost = rig.faults.doubled = rig.faults.reordered = 0.01;
  for (int ms = 0; ms < 1000; ++ms) {
    rig.run_ms();
    ASSERT_TRUE(rig.is_driven());
    ASSERT_NEAR(rig.felt_along_n(), before, 0.2) << ms;
  }
  rig.faults = {};
  rig.faults.host_is_silent = true;
  for (int ms = 0; ms < 27; ++ms) rig.run_ms();
  EXPECT_FALSE(rig.is_driven());
  rig.faults.host_is_silent = false;
  for (int ms = 0; ms < 100; ++ms) rig.run_ms();
  EXPECT_TRUE(rig.is_driven()) << "recovered";
}

TEST(ClosedLoop, AnswersWithin700UsWhateverItsLegsDo) {
  std::vector<double> trips;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RigOptions options = with_hand(1);
    options.seed = seed;
    OurRig rig(options);
    for (int ms = 0; ms < 700; ++ms) {  // into the wall, along it, out again
      const double t = 1e-3 * ms;
      rig.plant().set_intent(
          {rig.start() + Vec3{20 * std::sin(9 * t), 0, -25 * std::sin(4.5 * t)}, {}});
      rig.run_ms();
    }
    ASSERT_GT(rig.round_trips_us().size(), 600U);
    // The first are those of the calibration, whose frames are longer.
    trips.insert(trips.end(), rig.round_trips_us().begin() + 20, rig.round_trips_us().end());
  }
  std::sort(trips.begin(), trips.end());
  std::printf(
      "round trip with legs that move at their stops: p50 %.0f us, p90 %.0f us, worst %.0f us\n",
      trips[trips.size() / 2], trips[trips.size() * 9 / 10], trips.back());
  EXPECT_LE(trips.back(), 700);
}

}  // namespace
}  // namespace carpus::bench
