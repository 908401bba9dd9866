// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cases/posture.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "fields/distance_field.hpp"
#include "haptics/contact_force.hpp"
#include "instruments/drilling_resistance.hpp"
#include "instruments/guide_wire.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation {
namespace {

using test::Operator;
using test::posed_wrist;

bool has_event(const Snapshot& snapshot, EventKind kind) {
  for (std::size_t i = 0; i < snapshot.event_count; ++i) {
    if (snapshot.events[i].kind == kind) return true;
  }
  return false;
}

World make_world() {
  return World(posed_wrist(), procedure::ProcedureId::DorsalScaphoidFixation, 1);
}

double tip_depth_in(BoneId id, const Vec3& tip) {
  const cases::Bone* bone = cases::find_bone(posed_wrist(), id);
  const Vec3 local = (bone->patient_from_bone.inverse() * Point<frame::Patient>{tip}).v;
  return -fields::sample_distance(bone->distance_field, local).distance_mm;
}

TEST(World, TheFreeWireNeverEntersBone) {
  World world = make_world();
  Rng rng(7);
  double deepest = -1;
  const Vec3 centre = cases::test::synthetic_scaphoid().centre;
  Input input;
  input.shaft_in_patient = {0, 1, 0.5};
  for (int i = 0; i < 20000; ++i) {
    if (i % 50 == 0) {
      input.tip_in_patient =
          centre + Vec3{rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-20, 40)};
      input.shaft_in_patient = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    }
    const Snapshot& now = world.step(input);
    for (const BoneId id : {BoneId::Scaphoid, BoneId::Radius, BoneId::Lunate}) {
      deepest = std::max(deepest, tip_depth_in(id, now.tip_in_patient));
      for (double along = 3; along < 60; along += 3) {  // the shaft's middle line
        deepest =
            std::max(deepest, tip_depth_in(id, now.tip_in_patient + now.shaft_in_patient * along));
      }
    }
  }
  EXPECT_LT(deepest, 0.35) << "a wire that turns may cut in for a tick, by less than its radius";
}

TEST(World, TheTipSlidesOnTheSurfaceAndTheSpringPushesTheHandBack) {
  World world = make_world();
  const auto& marks = posed_wrist().scaphoid;
  const Vec3 inward = normalized_or(marks.central_axis.distal - marks.central_axis.proximal, {});
  Input input;
  input.shaft_in_patient = -inward;
  input.tip_in_patient = marks.central_axis.proximal - inward * 20.0;
  for (int i = 0; i < 50; ++i) world.step(input);
  input.tip_in_patient = marks.central_axis.proximal + inward * 2.0;
  for (int i = 0; i < 300; ++i) world.step(input);
  const Snapshot& now = world.now();
  ASSERT_TRUE(now.contact.touching);
  EXPECT_EQ(now.contact.label, static_cast<std::uint8_t>(BoneId::Scaphoid));
  EXPECT_NEAR(now.contact.depth_mm, 2.0, 0.15);
  EXPECT_NEAR(tip_depth_in(BoneId::Scaphoid, now.tip_in_patient), 0.0, 0.06);
  EXPECT_NEAR(dot(now.force_in_patient, -inward), 2.0 * haptics::kContactStiffnessNPerMm, 0.4);
}

TEST(World, DrillingNeedsThrustAboveTheResistanceAndFeelsTheCortex) {
  Operator op(posed_wrist());
  op.place_on_entry({});
  const Snapshot& idle = op.hold(Driver::Forward, 5.0, 200);
  EXPECT_TRUE(idle.wire.engaged);
  EXPECT_LT(idle.wire.depth_mm, 0.5) << "5 N do not open the subchondral bone";
  double greatest_at_entry = 0;
  double least_inside = 100;
  while (op.now().wire.depth_mm < 12.0) {
    op.hold(Driver::Forward, 30.0, 1);
    const double r = op.now().resistance_n;
    if (op.now().wire.depth_mm < 2.0) greatest_at_entry = std::max(greatest_at_entry, r);
    if (op.now().wire.depth_mm > 5.0) least_inside = std::min(least_inside, r);
    ASSERT_LT(op.now().tick, 60000U);
  }
  EXPECT_GT(greatest_at_entry, 15.0);
  EXPECT_LT(least_inside, 10.0);
  EXPECT_EQ(op.now().wire.passes, 1U);
}

TEST(World, TellsOfTheFarSideAndOfWrongBones) {
  Operator op(posed_wrist());
  op.place_on_entry({});
  bool left = false;
  bool wrong = false;
  for (int i = 0; i < 30000 && !(left && wrong); ++i) {
    op.hold(Driver::Forward, 50.0, 1);
    left = left || has_event(op.now(), EventKind::WireLeftBone);
    if (has_event(op.now(), EventKind::WrongBone)) {
      wrong = true;
      EXPECT_TRUE(left) << "the trapezium lies beyond the distal pole";
    }
  }
  EXPECT_TRUE(left);
  EXPECT_TRUE(wrong);
  const auto record = op.world().operation_record();
  EXPECT_EQ(record.far_exits, 1U);
  EXPECT_EQ(record.wrong_bones, 1U << static_cast<unsigned>(BoneId::Trapezium));
}

TEST(World, ReverseTakesTheWireOutAndAnotherPassCounts) {
  Operator op(posed_wrist());
  op.place_on_entry({});
  op.drive_to(8.0);
  op.hold(Driver::Reverse, 0.0, 3000);
  EXPECT_FALSE(op.now().wire.engaged);
  op.hold(Driver::Off, 0.0, 100);
  op.drive_to(3.0);
  EXPECT_EQ(op.now().wire.passes, 2U);
}

TEST(World, AFlatWireSkatesInsteadOfEngaging) {
  World world = make_world();
  const auto body = cases::test::synthetic_scaphoid();
  // Beside the proximal pole the surface falls away steeply under a wire along the axis.
  const auto& marks = posed_wrist().scaphoid;
  const Vec3 outward = normalized_or(marks.central_axis.proximal - marks.central_axis.distal, {});
  const double z = dot(outward, body.rotation.column(2)) > 0 ? 0.75 : -0.75;
  const Vec3 p = body.surface_point(normalized_or(Vec3{0.0, std::sqrt(1 - z * z), z}, {}));
  const Vec3 away = body.rotation.column(1);
  Input input;
  input.shaft_in_patient = outward;
  for (double side = 3.0; side > -0.2; side -= 0.01) {
    input.tip_in_patient = p + away * side;
    world.step(input);
  }
  ASSERT_TRUE(world.now().contact.touching);
  input.driver = Driver::Forward;
  input.thrust_n = 20;
  const auto slips_in = [&](int ticks) {
    int slips = 0;
    for (int i = 0; i < ticks; ++i) {
      world.step(input);
      slips += has_event(world.now(), EventKind::Slipped) ? 1 : 0;
    }
    return slips;
  };
  EXPECT_EQ(slips_in(5), 1) << "told once while the driver turns";
  EXPECT_FALSE(world.now().wire.engaged) << "68 degrees from the normal";
  input.driver = Driver::Off;
  EXPECT_EQ(slips_in(1), 0);
  input.driver = Driver::Forward;
  EXPECT_EQ(slips_in(2), 1) << "and again when it is started anew";
}

TEST(World, MeasuresBetweenTheCorticesWhereTheWireIsThrough) {
  Operator op(posed_wrist());
  op.place_on_entry({});
  op.drive_to(24.0);
  const double inside = [&] {
    op.command({CommandKind::Measure, 0, 0, 0});
    return op.now().measured_mm;
  }();
  EXPECT_NEAR(inside, 24.0, 0.3);
  op.drive_to(40.0);
  EXPECT_TRUE(has_event(op.command({CommandKind::Measure, 0, 0, 0}), EventKind::Measured));
  EXPECT_GT(op.now().measured_mm, inside);
  EXPECT_LT(op.now().measured_mm, op.now().wire.depth_mm - 5.0);
}

TEST(World, MeasuresChoosesAndInsertsAScrew) {
  Operator op(posed_wrist());
  EXPECT_TRUE(has_event(op.command({CommandKind::Measure, 0, 0, 0}), EventKind::Refused));
  EXPECT_TRUE(has_event(op.command({CommandKind::SelectScrew, 2, 0, 0}), EventKind::Refused));
  op.place_on_entry({});
  op.drive_to(24.0);
  EXPECT_TRUE(has_event(op.command({CommandKind::Measure, 0, 0, 0}), EventKind::Measured));
  EXPECT_NEAR(op.now().measured_mm, op.now().wire.depth_mm, 0.26);
  op.command({CommandKind::SelectScrew, 3, 0, 0});
  EXPECT_EQ(op.now().instrument, Instrument::ScrewDriver);
  EXPECT_EQ(op.now().screw.length_mm, 20.0);
  EXPECT_EQ(op.now().screw.buried_mm, -20.0);
  const double before = op.now().screw.advance_mm;
  op.hold(Driver::Forward, 0.0, 500);
  EXPECT_EQ(op.now().screw.advance_mm, before) << "no thrust, no bite";
  while (op.now().screw.buried_mm < 1.0) {
    op.hold(Driver::Forward, 30.0, 1);
    ASSERT_LT(op.now().tick, 120000U);
  }
  EXPECT_NE(op.now().completed_steps & 1U << static_cast<unsigned>(procedure::Step::Insert), 0U);
  EXPECT_EQ(op.now().step, procedure::Step::Verify) << "the survey was left out and is past";
  EXPECT_EQ(op.now().instrument, Instrument::ScrewDriver);
  EXPECT_TRUE(has_event(op.command({CommandKind::SelectScrew, 1, 0, 0}), EventKind::Refused))
      << "another screw needs the first one out";
}

TEST(World, SeatedScrewLiesAloneWhileTheDriverIsLetGo) {
  Operator op(posed_wrist());
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command({CommandKind::SelectScrew, 3, 0, 0});
  op.hold(Driver::Forward, 30.0, 500);
  ASSERT_LT(op.now().screw.buried_mm, 0.0);
  EXPECT_EQ(op.hold(Driver::Off, 0.0, 1).instrument, Instrument::ScrewDriver) << "not seated yet";
  while (op.now().screw.buried_mm < 0.5) {
    op.hold(Driver::Forward, 30.0, 1);
    ASSERT_LT(op.now().tick, 120000U);
  }
  EXPECT_EQ(op.now().instrument, Instrument::ScrewDriver) << "the driver still turns";
  const double seated = op.now().screw.buried_mm;
  EXPECT_EQ(op.hold(Driver::Off, 0.0, 1).instrument, Instrument::None);
  EXPECT_EQ(op.now().screw.buried_mm, seated);
  EXPECT_TRUE(op.now().wire.engaged) << "the line of the screw";
  EXPECT_EQ(op.hold(Driver::Forward, 30.0, 100).instrument, Instrument::ScrewDriver);
  EXPECT_GT(op.now().screw.buried_mm, seated) << "it drives on";
  op.hold(Driver::Forward, 30.0, 1);
  EXPECT_EQ(op.command({CommandKind::Finish, 0, 0, 0}).instrument, Instrument::None);
}

TEST(World, UnseatedScrewBacksOutWithTheDriverOn) {
  Operator op(posed_wrist());
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command({CommandKind::SelectScrew, 3, 0, 0});
  while (op.now().screw.buried_mm < 0.1) op.hold(Driver::Forward, 30.0, 1);
  ASSERT_EQ(op.hold(Driver::Off, 0.0, 1).instrument, Instrument::None);
  while (op.now().screw.buried_mm >= 0.0) op.hold(Driver::Reverse, 0.0, 1);
  EXPECT_EQ(op.hold(Driver::Off, 0.0, 1).instrument, Instrument::ScrewDriver);
}

TEST(World, UndoBringsBackTheCheckpointButNotTheCost) {
  Operator op(posed_wrist());
  EXPECT_TRUE(has_event(op.command({CommandKind::Undo, 0, 0, 0}), EventKind::Refused));
  op.command({CommandKind::TakeShot, 0, 0, 0});
  op.place_on_entry({});
  op.drive_to(10.0);
  const Tick spent = op.now().tick;
  op.command({CommandKind::Undo, 0, 0, 0});
  EXPECT_FALSE(op.now().wire.engaged);
  EXPECT_EQ(op.now().undos, 1U);
  EXPECT_EQ(op.now().shots, 1U);
  EXPECT_GT(op.now().tick, spent);
}

TEST(World, BadInputChangesNothingAndIsCounted) {
  World world = make_world();
  Input input;
  input.tip_in_patient = {0, 40, 60};
  world.step(input);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  Input bad = input;
  bad.tip_in_patient = {nan, inf, 0};
  bad.shaft_in_patient = {0, 0, 0};
  bad.thrust_n = nan;
  bad.driver = static_cast<Driver>(77);
  bad.command = {static_cast<CommandKind>(99), 1 << 30, nan, inf};
  for (int i = 0; i < 100; ++i) {
    const Snapshot& now = world.step(bad);
    ASSERT_TRUE(is_finite(now.tip_in_patient));
    ASSERT_TRUE(is_finite(now.force_in_patient));
  }
  EXPECT_EQ(world.faults().bad_inputs, 100U);
  bad.command = {CommandKind::TakeShot, 0, nan, 0};
  EXPECT_TRUE(has_event(world.step(bad), EventKind::Refused));
  bad.command = {CommandKind::SelectScrew, -5, 0, 0};
  EXPECT_TRUE(has_event(world.step(bad), EventKind::Refused));
}

TEST(World, StandsStillOnceFinished) {
  Operator op(posed_wrist());
  op.command({CommandKind::Finish, 0, 0, 0});
  const Snapshot last = op.now();
  EXPECT_TRUE(last.finished);
  EXPECT_EQ(last.step, procedure::Step::Finished);
  op.hold(Driver::Forward, 30.0, 10);
  EXPECT_EQ(op.now().tick, last.tick);
  EXPECT_EQ(op.now().state_hash, last.state_hash);
}

TEST(World, StepsAreTickedOffByWhatIsDone) {
  Operator op(posed_wrist());
  const auto done = [&](procedure::Step step) {
    return (op.now().completed_steps >> static_cast<unsigned>(step) & 1U) != 0;
  };
  op.command({CommandKind::TakeShot, 0, 0, 0});
  op.command({CommandKind::TakeShot, 0, 5, 0});
  EXPECT_FALSE(done(procedure::Step::Survey)) << "5 degrees apart are one view";
  op.command({CommandKind::TakeShot, 0, 90, 0});
  EXPECT_TRUE(done(procedure::Step::Survey));
  op.place_on_entry({});
  EXPECT_TRUE(done(procedure::Step::Entry));
  EXPECT_FALSE(done(procedure::Step::Aim));
  op.drive_to(2.0);
  EXPECT_TRUE(done(procedure::Step::Aim));
  op.drive_to(24.0);
  EXPECT_TRUE(done(procedure::Step::Drive));
  op.command({CommandKind::TakeShot, 0, 0, 0});
  op.command({CommandKind::TakeShot, 0, 90, 0});
  EXPECT_FALSE(done(procedure::Step::Check)) << "the 45 degree pronated oblique is missing";
  op.command({CommandKind::TakeShot, 0, 45, 0});
  EXPECT_TRUE(done(procedure::Step::Check));
}

TEST(World, NeedsAScaphoidACtAndFields) {
  const auto make = [](const cases::CaseData& data) {
    return World(data, procedure::ProcedureId::DorsalScaphoidFixation, 1);
  };
  cases::CaseData no_field = posed_wrist();
  no_field.bones.front().distance_field = {};
  EXPECT_THROW(make(no_field), InvalidInput);
  cases::CaseData no_ct = posed_wrist();
  no_ct.ct = {};
  EXPECT_THROW(make(no_ct), InvalidInput);
  cases::CaseData no_scaphoid = posed_wrist();
  std::erase_if(no_scaphoid.bones,
                [](const cases::Bone& bone) { return bone.bone == BoneId::Scaphoid; });
  EXPECT_THROW(make(no_scaphoid), InvalidInput);
}

}  // namespace
}  // namespace carpus::simulation
