// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/operation_feel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/allocation_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::haptics {
namespace {

/// Of a hand that is so deep in them, without damping [N].
double press_into(const Felt& felt, const Vec3& hand) {
  double sum = 0;
  for (std::size_t i = 0; i < felt.plane_count; ++i) {
    const SurfacePlane& plane = felt.planes[i];
    sum += std::max(0.0, plane.offset_mm - dot(plane.normal, hand)) * plane.feel.stiffness_n_per_mm;
  }
  return sum;
}

FeltMoment over_bone(double gap_mm) {
  FeltMoment moment;
  moment.tip = moment.wish = {1, 2, gap_mm};
  moment.near = {true, gap_mm, {0, 0, 1}, true};
  return moment;
}

TEST(FeelTable, IsWhatItsFileSaysAndEachFigureHasItsMark) {
  const FeelTable& table = feel_table();
  EXPECT_NEAR(table.cartilage.thickness_mm, 0.6, 0.2);    // [S75]: 0.6 to 0.8 on the distal radius
  EXPECT_GE(table.cartilage.feel.stiffness_n_per_mm, 1);  // B11
  EXPECT_LE(table.cartilage.feel.stiffness_n_per_mm, 3);
  EXPECT_GT(table.bone.feel.stiffness_n_per_mm, 3 * table.cartilage.feel.stiffness_n_per_mm);
  EXPECT_LT(table.soft_tissue.feel.stiffness_n_per_mm, table.cartilage.feel.stiffness_n_per_mm);
  EXPECT_LT(table.cartilage.feel.friction, table.bone.feel.friction);
  EXPECT_THROW((void)read_feel_table("{}"), InvalidInput);
  EXPECT_THROW((void)read_feel_table("nothing"), InvalidInput);
  EXPECT_THROW((void)read_feel_table(R"({"schema_version": 1, "tissues": [{"id": "bone",
      "stiffness_n_per_mm": 10, "damping_s": 0.002, "friction": 0.3, "thickness_mm": 0}]})"),
               InvalidInput);
}

TEST(OperationFeel, CartilageIsFeltBeforeTheBoneUnderIt) {
  OperationFeel feel(feel_table());
  const double thick = feel_table().cartilage.thickness_mm;
  const Felt far = feel.feel(over_bone(10));
  EXPECT_EQ(far.plane_count, 0U);
  const Felt felt = feel.feel(over_bone(2));
  ASSERT_EQ(felt.plane_count, 2U);
  EXPECT_EQ(press_into(felt, {0, 0, thick + 0.01}), 0) << "nothing is felt in free space";
  const double in_cartilage = press_into(felt, {0, 0, 0.01});
  EXPECT_NEAR(in_cartilage, 0.9, 0.05);
  const double deeper = press_into(felt, {0, 0, -0.1}) - press_into(felt, {0, 0, 0});
  EXPECT_NEAR(deeper / 0.1, feel_table().bone.feel.stiffness_n_per_mm, 1e-6);
  FeltMoment weak = over_bone(2);
  weak.most_n_per_mm = 2;
  const Felt soft = feel.feel(weak);
  EXPECT_NEAR(soft.planes[0].feel.stiffness_n_per_mm, 0.8, 1e-9);
  EXPECT_NEAR(soft.planes[1].feel.stiffness_n_per_mm, 1.2, 1e-9) << "together what it can";
  // The same planes wherever the tip is above them: the first touch is the device's own.
  const Felt nearer = feel.feel(over_bone(0.7));
  EXPECT_NEAR(nearer.planes[0].offset_mm, felt.planes[0].offset_mm, 1e-12);
  FeltMoment pointed = over_bone(1);
  pointed.is_pointed = true;
  EXPECT_EQ(feel.feel(pointed).plane_count, 1U) << "a point goes through what is soft";
}

TEST(OperationFeel, AToolThatItsShaftHoldsIsHeldThere) {
  OperationFeel feel(feel_table());
  FeltMoment moment;
  moment.tip = {0, 0, 0};
  moment.wish = {-1, 0, 0};
  moment.is_held_back = true;
  const Felt felt = feel.feel(moment);
  ASSERT_EQ(felt.plane_count, 1U);
  EXPECT_EQ(felt.planes[0].normal, (Vec3{1, 0, 0}));
  moment.near = {true, 0.02, {0, 0, 1}, false};
  EXPECT_EQ(feel.feel(moment).plane_count, 2U);
  // What friction leans a little is the surface's own.
  moment.wish = {-0.4, 0, -1};
  EXPECT_EQ(feel.feel(moment).planes[0].normal, (Vec3{0, 0, 1}));
}

TEST(OperationFeel, ALineInBoneHoldsBothWaysAndAside) {
  OperationFeel feel(feel_table());
  FeltMoment moment;
  moment.is_in_bone = true;
  moment.shaft = {0, 0, 1};
  moment.wish = {0.5, 0, -1};
  const Felt pressed = feel.feel(moment);
  ASSERT_EQ(pressed.plane_count, 2U);
  EXPECT_EQ(pressed.planes[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(pressed.planes[1].normal, (Vec3{-1, 0, 0}));
  EXPECT_GT(press_n(moment, 2), 1.9);
  moment.wish = {0, 0, 1};
  EXPECT_EQ(feel.feel(moment).planes[0].normal, (Vec3{0, 0, -1}));
  EXPECT_EQ(press_n(moment, 2), 0);
}

TEST(OperationFeel, ThrustIsThePressScaledSoThatTheHardestBoneIsWithinTheDevice) {
  const DrillingFeel& feel = feel_table().drilling;
  EXPECT_NEAR(thrust_of_press_n(feel, 0.8 * 8, 8), 45, 1e-9);
  EXPECT_NEAR(thrust_of_press_n(feel, 2, 200), 2, 1e-9) << "a strong device feels it as it is";
  EXPECT_EQ(thrust_of_press_n(feel, -1, 8), 0);
  EXPECT_EQ(thrust_of_press_n(feel, 1, 0), 0);
  EXPECT_EQ(thrust_of_press_n(feel, std::nan(""), 8), 0);
}

TEST(OperationFeel, ADrillShakesMoreAndSlowerTheHarderTheBoneAndTheFasterItGoes) {
  const DrillingFeel& feel = feel_table().drilling;
  const Shake air = drill_shake(feel, 0, 0);
  const Shake marrow = drill_shake(feel, 6, 0.5);
  const Shake cortex = drill_shake(feel, 30, 0.5);
  const Shake blunt = drill_shake(feel, 30, 0);
  EXPECT_LT(air.size_n, marrow.size_n);
  EXPECT_LT(marrow.size_n, blunt.size_n);
  EXPECT_LT(blunt.size_n, cortex.size_n);
  EXPECT_GT(air.rate_hz, marrow.rate_hz);
  EXPECT_GT(marrow.rate_hz, cortex.rate_hz);
  EXPECT_NEAR(air.rate_hz, 50, 1);
}

TEST(OperationFeel, AScrewTicksTwelveTimesATurnAsStrongAsItsTorque) {
  OperationFeel feel(feel_table());
  const auto turn = [&feel](double torque) {
    FeltMoment moment;
    moment.is_in_bone = moment.is_turning = true;
    moment.turned_by = TurnedBy::Hand;
    moment.torque_n_mm = torque;
    int ticks = 0;
    double strongest = 0;
    bool was_on = false;
    for (int ms = 0; ms < 1000; ++ms) {
      moment.turns = ms / 1000.0;
      const Felt felt = feel.feel(moment);
      const bool is_on = felt.vibration_n > 0;
      ticks += is_on && !was_on ? 1 : 0;
      was_on = is_on;
      strongest = std::max(strongest, felt.vibration_n);
    }
    feel.rest();
    return std::pair(ticks, strongest);
  };
  const auto [loose_ticks, loose] = turn(20);
  const auto [tight_ticks, tight] = turn(140);
  EXPECT_EQ(loose_ticks, 11);  // the first begins the count
  EXPECT_EQ(tight_ticks, 11);
  EXPECT_GT(tight, 2 * loose);
  // A driver that stands still ticks no more.
  FeltMoment still;
  still.turned_by = TurnedBy::Hand;
  still.turns = 0.7;
  (void)feel.feel(still);
  for (int ms = 0; ms < 50; ++ms) EXPECT_EQ(feel.feel(still).vibration_n, 0);
}

TEST(OperationFeel, OfWhateverItIsToldItMakesOnlyNumbersAndTakesNoMemory) {
  Rng rng(11);
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), 1e300, -1e300, 0};
  const auto any = [&] { return rng.below(4) == 0 ? odd[rng.below(5)] : rng.uniform(-5, 5); };
  OperationFeel feel(feel_table());
  bool all_sound = true;
  test::start_counting_allocations();
  for (int i = 0; i < 5000; ++i) {
    FeltMoment moment;
    moment.tip = {any(), any(), any()};
    moment.wish = {any(), any(), any()};
    moment.shaft = normalized_or({any(), any(), any()}, {0, 0, 1});
    moment.is_in_bone = rng.below(2) == 0;
    moment.is_held_back = rng.below(2) == 0;
    moment.near = {rng.below(2) == 0, any(), {0, 0, 1}, rng.below(2) == 0};
    moment.turned_by = static_cast<TurnedBy>(rng.below(3));
    moment.is_turning = rng.below(2) == 0;
    moment.resistance_n = any();
    moment.feed_share = any();
    moment.turns = any();
    moment.torque_n_mm = any();
    const Felt felt = feel.feel(moment);
    for (std::size_t k = 0; k < felt.plane_count; ++k) {
      all_sound = all_sound && is_finite(felt.planes[k].normal);
    }
    all_sound = all_sound && std::isfinite(felt.vibration_n + felt.vibration_hz);
  }
  EXPECT_EQ(test::stop_counting_allocations(), 0);
  EXPECT_TRUE(all_sound);
}

}  // namespace
}  // namespace carpus::haptics
