// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "fields/distance_field.hpp"
#include "haptics/virtual_coupling.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::body_of;
using test::has_event;
using test::is_done;
using test::Operator;
using test::take;
using test::wrist;

double depth_in(const Snapshot& now, BoneId id, const Vec3& point) {
  const std::uint8_t body = body_of(id);
  const Vec3 local = (now.patient_from_bone[body].inverse() * Point<frame::Patient>{point}).v;
  return -fields::sample_distance(wrist().bones[body].distance_field, local).distance_mm;
}

TEST(FreeMotion, AFreeInstrumentNeverEntersBoneWhateverTheHandAndTheWristDo) {
  for (const char* id : {"guide_wire", "probe", "needle_sleeve_14g"}) {
    World world(wrist(), test::exercise(), 1);
    Rng rng(7);
    double deepest = -1;
    const Vec3 centre = cases::test::synthetic_scaphoid().centre;
    Input input;
    input.wrist = world.now().wrist;
    input.hands[0].tip_in_patient = {0, 100, 0};
    input.hands[1].tip_in_patient = {0, 160, 0};
    input.command = take(id);
    world.step(input);
    input.command = {};
    for (int i = 0; i < carpus::test::amount(4000, 12000, 120000); ++i) {
      if (i % 50 == 0) {
        input.hands[0].tip_in_patient =
            centre + Vec3{rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-20, 40)};
        input.hands[0].shaft_in_patient = {rng.uniform(-1, 1), rng.uniform(-1, 1),
                                           rng.uniform(-1, 1)};
      }
      if (i % 2000 == 0) input.wrist.flexion_rad = rng.uniform(-0.6, 0.6);
      const Snapshot& now = world.step(input);
      const ItemView& item = now.items[now.hands[0].item];
      for (const BoneId bone : {BoneId::Scaphoid, BoneId::Radius, BoneId::Lunate}) {
        const double back = instruments::catalogue()[item.instrument].shape.back_z_mm();
        for (double along = 2; along < back; along += 3) {  // the shaft's middle line
          deepest = std::max(
              deepest, depth_in(now, bone, item.tip_in_patient + item.shaft_in_patient * along));
        }
      }
    }
    EXPECT_LT(deepest, 0.35) << id << ": what turns may cut in for a tick, by less than its radius";
  }
}

TEST(FreeMotion, TheTipRestsOnTheSurfaceAndTheSpringPushesTheHandBack) {
  Operator op;
  op.place_on_entry({});
  for (int i = 0; i < 160; ++i) {  // pressed in at a hand's pace
    op.hand().tip_in_patient += op.inward() * 0.01;
    op.hold(Driver::Off, 0, 1);
  }
  const Snapshot& now = op.hold(Driver::Off, 0, 50);
  ASSERT_TRUE(now.hands[0].touching);
  EXPECT_EQ(now.hands[0].touched_body, body_of(BoneId::Scaphoid));
  EXPECT_NEAR(now.hands[0].contact_depth_mm, 2.0, 0.15);
  EXPECT_NEAR(depth_in(now, BoneId::Scaphoid, op.item().tip_in_patient), 0.0, 0.06);
  EXPECT_NEAR(dot(now.hands[0].force_in_patient, -op.inward()),
              2.0 * haptics::kContactStiffnessNPerMm, 0.4);
  EXPECT_TRUE(is_done(now, 0));
}

TEST(FreeMotion, AFlatWireSkatesInsteadOfEngaging) {
  Operator op;
  const auto body = cases::test::synthetic_scaphoid();
  // Beside the proximal pole the surface falls away steeply under a wire along the axis.
  const auto& marks = wrist().scaphoid;
  const Vec3 outward = normalized_or(marks.central_axis.proximal - marks.central_axis.distal, {});
  const double z = dot(outward, body.rotation.column(2)) > 0 ? 0.75 : -0.75;
  const auto& pose = op.now().patient_from_bone[body_of(BoneId::Scaphoid)];
  const Vec3 p = (pose * Point<frame::Bone>{body.surface_point(
                             normalized_or(Vec3{0.0, std::sqrt(1 - z * z), z}, {}))})
                     .v;
  const Vec3 away = (pose * Direction<frame::Bone>{body.rotation.column(1)}).v;
  for (double side = 3.0; side > -0.2; side -= 0.01) {
    op.hand().tip_in_patient = p + away * side;
    op.hold(Driver::Off, 0, 1);
  }
  ASSERT_TRUE(op.now().hands[0].touching);
  const auto slips_in = [&](Driver driver, int ticks) {
    int slips = 0;
    for (int i = 0; i < ticks; ++i) {
      op.hold(driver, 20, 1);
      slips += has_event(op.now(), EventKind::Slipped) ? 1 : 0;
    }
    return slips;
  };
  EXPECT_EQ(slips_in(Driver::Forward, 5), 1) << "told once while the driver turns";
  EXPECT_EQ(op.item().body, kNoBody) << "68 degrees from the normal";
  EXPECT_EQ(slips_in(Driver::Off, 1), 0);
  EXPECT_EQ(slips_in(Driver::Forward, 2), 1) << "and again when it is started anew";
}

/// Whoever holds a wire holds it outside the patient.
TEST(FreeMotion, AWireWhoseShaftLiesInTheForearmDoesNotGoIn) {
  Operator op;
  op.aim({});
  const Vec3 along_forearm = normalized_or(Vec3{0.1, -0.3, 1.0}, {});
  const auto drive = [&](const Vec3& shaft) {
    op.hand().shaft_in_patient = shaft;
    for (double away = 20.0; away > -0.5; away -= 0.05) {
      op.hand().tip_in_patient = op.entry() + shaft * away;
      op.hold(Driver::Off, 0.0, 1);
    }
    EXPECT_TRUE(op.now().hands[0].touching);
    op.hold(Driver::Forward, 30.0, 1);
    const bool is_told = has_event(op.now(), EventKind::ShaftUnderSkin);
    op.hold(Driver::Forward, 30.0, 300);
    return is_told;
  };
  EXPECT_TRUE(drive(along_forearm));
  EXPECT_EQ(op.item().body, kNoBody);
  op.hold(Driver::Off, 0.0, 1);
  EXPECT_FALSE(drive(-op.inward()));
  EXPECT_NE(op.item().body, kNoBody);
}

TEST(FreeMotion, ASleeveInTheOtherHandLeadsTheWireAndKeepsItFromSkating) {
  Operator op;
  op.command(take("needle_sleeve_14g", 1));
  op.aim({{0.5, 0, 0}, {}});
  const Vec3 entry = op.entry();
  const Vec3 inward = op.inward();
  HandInput& sleeve = op.hand(1);
  sleeve.shaft_in_patient = -inward;
  for (double away = 60.0; away > 1.5; away -= 0.1) {
    sleeve.tip_in_patient = entry - inward * away;
    op.hold(Driver::Off, 0, 1);
  }
  op.hold(Driver::Off, 0, 50);
  const Vec3 aside = any_perpendicular(inward);
  for (double away = 50.0; away > -0.5; away -= 0.1) {
    // A hand that is a millimetre off and points elsewhere.
    op.hand().tip_in_patient = entry - inward * away + aside * 1.0;
    op.hand().shaft_in_patient = -inward + aside * 0.2;
    op.hold(Driver::Off, 0, 1);
  }
  const ItemView& led = op.now().items[op.now().hands[1].item];
  EXPECT_NEAR(distance(op.item().shaft_in_patient, led.shaft_in_patient), 0.0, 1e-12);
  EXPECT_LT(length(cross(op.item().tip_in_patient - led.tip_in_patient, led.shaft_in_patient)),
            1e-9);
  op.hold(Driver::Forward, 30.0, 1500);
  EXPECT_NE(op.item().body, kNoBody);
  EXPECT_NEAR(length(cross(op.item().shaft_in_patient, led.shaft_in_patient)), 0.0, 1e-9);
}

}  // namespace
}  // namespace carpus::simulation
