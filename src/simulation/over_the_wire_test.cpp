// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "simulation/operation_test_support.hpp"
#include "simulation/permission.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::is_done;
using test::Operator;
using test::refusal_in;
using test::simple;
using test::take;

TEST(OverTheWire, TheGaugeReadsTheWireWhereverItsTipIs) {
  Operator op;
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::NoWireToRideOn);
  op.place_on_entry({});
  op.drive_to(24.0);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::NoGaugeInHand);
  EXPECT_EQ(refusal_in(op.command(take("depth_gauge", 1))), Refusal::None);
  op.command(simple(CommandKind::ReadGauge, 1));
  EXPECT_NEAR(op.now().gauge_reading_mm, op.item().depth_mm, 0.26);
  EXPECT_TRUE(is_done(op.now(), 3));
  op.command(simple(CommandKind::PutDown, 1));
  op.drive_to(33.0);  // out of the far side, which a gauge cannot know
  op.command(take("depth_gauge", 1));
  op.command(simple(CommandKind::ReadGauge, 1));
  EXPECT_NEAR(op.now().gauge_reading_mm, 33.0, 0.3);
}

/// Both are as long as each other: what the second stands out farther lies in the bone.
TEST(OverTheWire, ASecondWireHeldBesideTheFirstMeasuresIt) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("second_wire", 1));
  const Vec3 aside = normalized_or(cross(op.inward(), Vec3{0, 0, 1}), {1, 0, 0}) * 2.0;
  op.hand(1).shaft_in_patient = -op.inward();
  op.hand(1).tip_in_patient = op.entry() + aside - op.inward() * 40.0;
  op.hold(Driver::Off, 0.0, 200);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::NoGaugeInHand)
      << "it stands on nothing yet";
  for (double away = 40.0; away > -1.0; away -= 0.05) {
    op.hand(1).tip_in_patient = op.entry() + aside - op.inward() * away;
    op.hold(Driver::Off, 0.0, 1);
  }
  ASSERT_TRUE(op.now().hands[1].touching);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::None);
  EXPECT_NEAR(op.now().gauge_reading_mm, 24.0, 1.0);
  op.hand(1).shaft_in_patient = normalized_or(-op.inward() + aside * 0.4, {});
  op.hold(Driver::Off, 0.0, 300);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::ReadGauge, 1))), Refusal::NoGaugeInHand)
      << "not along it";
}

TEST(OverTheWire, ReamsOverTheWireAndHasTheWireAtHandAgain) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("cannulated_drill"));
  EXPECT_EQ(op.item().wire, 0);
  op.drive_to(12.0);
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::PutDown))), Refusal::HandIsFull)
      << "a reamer in bone has to be drawn back";
  op.hold(Driver::Reverse, 0.0, 12000);
  EXPECT_EQ(op.item().instrument, test::instrument("guide_wire"));
  EXPECT_NEAR(op.world().operation_record().reamed_mm, 12.0, 0.1);
  EXPECT_EQ(op.now().track_count, 2);
}

TEST(OverTheWire, AScrewHoldsByTheBoneThatIsLeftAroundIt) {
  const auto holding_after = [](bool is_spoilt) {
    Operator op;
    if (is_spoilt) {  // passes where its thread will run
      for (const double aside : {1.7, -1.7}) {
        op.place_on_entry({{aside, 0, 0}, {aside, 0, 0}});
        op.drive_to(20.0);
        op.hold(Driver::Reverse, 0.0, 5000);
      }
    }
    op.place_on_entry({});
    op.drive_to(24.0);
    op.command(take("acutrak_standard_1994_20"));
    EXPECT_NEAR(op.item().buried_mm, -20.0, 0.1);
    const double before = op.item().depth_mm;
    op.hold(Driver::Forward, 0.0, 500);
    EXPECT_EQ(op.item().depth_mm, before) << "no thrust, no bite";
    op.bury(1.0);
    EXPECT_TRUE(is_done(op.now(), 4));
    return op.now().holding_share;
  };
  const double whole = holding_after(false);
  const double spoilt = holding_after(true);
  EXPECT_GT(whole, 0.95);
  EXPECT_LT(spoilt, whole - 0.05);
  EXPECT_GT(spoilt, 0.3);
}

TEST(OverTheWire, ASeatedScrewStaysWhenItIsLetGoAndBacksOutWhenTakenUpAgain) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("acutrak_standard_1994_20"));
  op.bury(0.5);
  const std::uint8_t screw = op.now().hands[0].item;
  EXPECT_EQ(refusal_in(op.command({CommandKind::PickUp, 1, 0, 0, 0})), Refusal::SomethingRidesOnIt);
  op.command(simple(CommandKind::PutDown));
  EXPECT_EQ(op.now().hands[0].item, kNoItem);
  EXPECT_EQ(op.now().items[screw].hand, kNoHand);
  EXPECT_NEAR(op.now().items[screw].buried_mm, 0.5, 0.01);
  EXPECT_EQ(op.now().step, 5) << "what was left out before is past";
  EXPECT_EQ(refusal_in(op.command({CommandKind::PickUp, 0, screw, 0, 0})), Refusal::None);
  op.hold(Driver::Reverse, 0.0, 1000);
  EXPECT_LT(op.item().buried_mm, 0.0);
  EXPECT_FALSE(is_done(op.now(), 4));
}

TEST(OverTheWire, TheWireCanGoWhileTheScrewStays) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command(take("acutrak_standard_1994_20"));
  op.bury(1.0);
  const std::uint8_t screw = op.now().hands[0].item;
  EXPECT_EQ(refusal_in(op.command(simple(CommandKind::PutDown))), Refusal::None);
  EXPECT_EQ(refusal_in(op.command({CommandKind::PickUp, 0, 0, 0, 0})), Refusal::None)
      << "a seated screw does not hold the wire on which it came";
  op.hold(Driver::Reverse, 0.0, 6000);
  EXPECT_EQ(op.item().body, kNoBody);
  EXPECT_NEAR(op.now().items[screw].buried_mm, 1.0, 0.01);
  EXPECT_TRUE(op.now().items[screw].in_target);
}

}  // namespace
}  // namespace carpus::simulation
