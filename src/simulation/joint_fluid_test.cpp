// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/joint_fluid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.hpp"

namespace carpus::simulation::detail {
namespace {

constexpr double kTick = 0.001;
constexpr double kScopeMm = 1.9;

const FluidTable& table() { return FluidTable::generic(); }
constexpr procedure::FluidUse kTourniquet{true};

FluidAround scope_in() {
  FluidAround around;
  around.sheath_mm = kScopeMm;
  return around;
}

void run(JointFluid& fluid, const FluidAround& around, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds / kTick); ++i) {
    flow(fluid, table(), kTourniquet, around, kTick);
  }
}

/// Under pressure, with so much blood in it.
JointFluid filled(double blood = 0.0) {
  JointFluid fluid = fluid_at_first(table());
  run(fluid, scope_in(), 20);
  fluid.blood = blood;
  return fluid;
}

TEST(JointFluid, ItsVolumeIsWhatCameInLessWhatWentOut) {
  JointFluid fluid = fluid_at_first(table());
  Rng rng(7);
  FluidAround around = scope_in();
  for (int i = 0; i < 200'000; ++i) {
    if (i % 1000 == 0) {
      around.open_portals = static_cast<std::uint32_t>(rng.below(4));
      around.suction_ml_per_s = 0.3 * static_cast<double>(rng.below(4));
      around.sheath_mm = rng.below(4) == 0 ? 0.0 : kScopeMm;
      set(fluid, table(), FluidControl::Inflow, static_cast<std::uint8_t>(rng.below(21)));
      set(fluid, table(), FluidControl::Outflow, static_cast<std::uint8_t>(rng.below(2)));
      if (rng.below(5) == 0) set(fluid, table(), FluidControl::Flush, 0);
      bleed(fluid, table(), 0.01);
    }
    const double before = volume_ml(fluid, table());
    const FluidMoved m = flow(fluid, table(), kTourniquet, around, kTick);
    const double gained = m.in + m.blood - m.out - m.leak - m.tissue - m.suction;
    ASSERT_NEAR(volume_ml(fluid, table()) - before, gained, 1e-12) << i;
    ASSERT_GE(fluid.pressure_mmhg, 0.0);
    ASSERT_GE(fluid.blood, 0.0);
    ASSERT_LE(fluid.blood, 1.0);
    ASSERT_TRUE(is_possible(fluid, table(), 2, 10));
  }
}

TEST(JointFluid, ComesToRestWhereInflowAndOutflowAreEqual) {
  const JointFluid fluid = filled();
  const double in = 1.0 / table().source.sheath_mmhg_s_per_ml;
  const double out = 1.0 / table().joint.outflow_mmhg_s_per_ml;
  EXPECT_NEAR(fluid.pressure_mmhg, table().source.inflow_mmhg * in / (in + out), 0.01);
  EXPECT_EQ(fluid.facts.tissue_ml, 0.0) << "as it is set at first nothing is harmed";
  EXPECT_GT(fluid.pressure_mmhg, table().bleeding.tourniquet_mmhg) << "and nothing bleeds";
}

TEST(JointFluid, RisesToItWithTheTimeOfComplianceAndResistance) {
  JointFluid fluid = fluid_at_first(table());
  set(fluid, table(), FluidControl::Outflow, 0);
  const double seconds = table().joint.ml_per_mmhg * table().source.sheath_mmhg_s_per_ml;
  run(fluid, scope_in(), seconds);
  EXPECT_NEAR(fluid.pressure_mmhg, table().source.inflow_mmhg * (1 - std::exp(-1.0)), 0.02);
}

TEST(JointFluid, NoStepIsTooLong) {
  for (const double seconds : {0.001, 0.1, 1.0, 100.0, 1e6}) {
    JointFluid fluid = fluid_at_first(table());
    fluid.pressure_mmhg = 170;
    FluidAround around = scope_in();
    around.open_portals = 3;
    for (int i = 0; i < 50; ++i) {
      flow(fluid, table(), kTourniquet, around, seconds);
      EXPECT_GE(fluid.pressure_mmhg, 0.0) << seconds;
      EXPECT_LE(fluid.pressure_mmhg, 170.0) << seconds;
      EXPECT_LE(fluid.smear + fluid.chill, 2.0) << seconds;
    }
  }
}

TEST(JointFluid, SuctionTakesNoMoreThanThereIsAndThenAir) {
  JointFluid fluid = filled();
  FluidAround around = scope_in();
  around.suction_ml_per_s = 5;
  run(fluid, around, 3);
  EXPECT_EQ(fluid.pressure_mmhg, 0.0);
  EXPECT_GT(fluid.air_ml, table().air.shown_ml) << "the picture is full of bubbles";
  around.suction_ml_per_s = 0.2;
  JointFluid gently = filled();
  const double before = gently.pressure_mmhg;
  run(gently, around, 10);
  EXPECT_LT(gently.pressure_mmhg, before);
  EXPECT_GT(gently.pressure_mmhg, 0.0);
  EXPECT_EQ(gently.air_ml, 0.0);
}

TEST(JointFluid, FlowWashesBloodOutByVolumeAndFlow) {
  JointFluid fluid = filled(0.1);
  const double flow_ml_per_s =
      (table().source.inflow_mmhg - fluid.pressure_mmhg) / table().source.sheath_mmhg_s_per_ml;
  run(fluid, scope_in(), volume_ml(fluid, table()) / flow_ml_per_s);
  EXPECT_NEAR(fluid.blood, 0.1 * std::exp(-1.0), 0.001);
}

TEST(JointFluid, WithoutAnOutflowItStaysCloudy) {
  JointFluid fluid = filled(0.1);
  set(fluid, table(), FluidControl::Outflow, 0);
  run(fluid, scope_in(), 120);
  EXPECT_GT(fluid.blood, 0.08);
  EXPECT_FALSE(is_clear(fluid, table(), 10));
  set(fluid, table(), FluidControl::Outflow, 1);
  run(fluid, scope_in(), 60);
  EXPECT_TRUE(is_clear(fluid, table(), 10));
}

TEST(JointFluid, PressureStopsBleedingAndATourniquetLowersWhatItTakes) {
  const auto bled_in_10_s = [](double set_mmhg, bool has_tourniquet) {
    JointFluid fluid = fluid_at_first(table());
    set(fluid, table(), FluidControl::Inflow,
        static_cast<std::uint8_t>(set_mmhg / table().source.step_mmhg));
    run(fluid, scope_in(), 20);
    bleed(fluid, table(), 0.02);
    double bled = 0;
    for (int i = 0; i < 10'000; ++i) {
      bled += flow(fluid, table(), {has_tourniquet}, scope_in(), kTick).blood;
    }
    return bled;
  };
  EXPECT_EQ(bled_in_10_s(35, true), 0.0);
  EXPECT_GT(bled_in_10_s(10, true), 0.02);
  EXPECT_GT(bled_in_10_s(35, false), 0.02);
  EXPECT_EQ(bled_in_10_s(65, false), 0.0);
  EXPECT_LT(bled_in_10_s(10, true), bled_in_10_s(10, false));
}

TEST(JointFluid, TooMuchPressureIsLostIntoTheTissueAndCounted) {
  JointFluid fluid = fluid_at_first(table());
  set(fluid, table(), FluidControl::Inflow, 20);
  set(fluid, table(), FluidControl::Outflow, 0);
  double lost = 0;
  for (int i = 0; i < 60'000; ++i) {
    lost += flow(fluid, table(), kTourniquet, scope_in(), kTick).tissue;
  }
  EXPECT_GT(lost, 5.0);
  EXPECT_NEAR(fluid.facts.tissue_ml, lost, 1e-9);
  EXPECT_TRUE(fluid.is_too_high);
  EXPECT_TRUE(fluid.has_swollen);
  EXPECT_GT(fluid.facts.over_limit_ticks, 50'000U);
}

TEST(JointFluid, ALargerSheathLetsMoreThrough) {
  JointFluid small = fluid_at_first(table());
  JointFluid large = small;
  FluidAround wide = scope_in();
  wide.sheath_mm = 2.7;
  const double by_small = flow(small, table(), kTourniquet, scope_in(), kTick).in;
  const double by_large = flow(large, table(), kTourniquet, wide, kTick).in;
  EXPECT_NEAR(by_large / by_small, std::pow(2.7 / 1.9, 4), 0.01);
}

TEST(JointFluid, FlowTakesBubblesOut) {
  JointFluid fluid = filled();
  let_air_in(fluid, table(), 0.3);
  run(fluid, scope_in(), 30);
  EXPECT_LT(fluid.air_ml, 0.05);
  JointFluid closed = filled();
  set(closed, table(), FluidControl::Outflow, 0);
  run(closed, scope_in(), 20);
  let_air_in(closed, table(), 0.3);
  run(closed, scope_in(), 30);
  EXPECT_NEAR(closed.air_ml, 0.3, 1e-6);
}

TEST(JointFluid, DryAColdLensIsMistUntilItIsWarmOrRinsed) {
  JointFluid fluid = fluid_at_first(table());
  set(fluid, table(), FluidControl::Dry, 1);
  run(fluid, scope_in(), 1);
  EXPECT_FALSE(is_clear(fluid, table(), 5));
  JointFluid rinsed = fluid;
  run(fluid, scope_in(), 30);
  EXPECT_TRUE(is_clear(fluid, table(), 5));
  EXPECT_EQ(fluid.pressure_mmhg, 0.0);
  set(rinsed, table(), FluidControl::Flush, 0);
  run(rinsed, scope_in(), table().source.flush_s + 1);
  EXPECT_FALSE(is_immersed(rinsed));
  EXPECT_TRUE(is_clear(rinsed, table(), 5));
}

TEST(JointFluid, DryBloodPoolsBeforeTheLensAndClingsToIt) {
  JointFluid fluid = fluid_at_first(table());
  set(fluid, table(), FluidControl::Dry, 1);
  run(fluid, scope_in(), 60);
  EXPECT_TRUE(is_clear(fluid, table(), 10));
  fluid.blood = 0.9;
  EXPECT_FALSE(is_clear(fluid, table(), 10)) << "nothing washes it away";
  fluid.blood = 0.1;
  EXPECT_TRUE(is_clear(fluid, table(), 10));
  FluidAround touching = scope_in();
  touching.lens_touches = true;
  run(fluid, touching, 20);
  EXPECT_FALSE(is_clear(fluid, table(), 10));
  run(fluid, {}, 5);
  EXPECT_LT(fluid.smear, 0.01) << "outside it is wiped";
}

TEST(JointFluid, WhatNoTickLeavesIsRefused) {
  const auto is_refused_after = [](auto spoil) {
    JointFluid fluid = filled(0.01);
    spoil(fluid);
    return !is_possible(fluid, table(), 2, 10);
  };
  EXPECT_FALSE(is_refused_after([](JointFluid&) {}));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.pressure_mmhg = -1; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.pressure_mmhg = 1e6; }));
  EXPECT_TRUE(
      is_refused_after([](JointFluid& f) { f.blood = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.blood = 1.5; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.bleeding_ml_per_s = 9; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.air_ml = 50; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.chill = 2; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.smear = -0.1; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.inflow_steps = 60; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.flush_ticks = 1'000'000; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.joint = 7; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.made = 1U << 20; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.occupied = ~f.made; }));
  EXPECT_TRUE(is_refused_after([](JointFluid& f) { f.facts.tissue_ml = -1; }));
  EXPECT_TRUE(
      is_refused_after([](JointFluid& f) { f.facts.clouded_ticks = f.facts.watched_ticks + 1; }));
}

}  // namespace
}  // namespace carpus::simulation::detail
