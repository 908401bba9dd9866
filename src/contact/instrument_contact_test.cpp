// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/instrument_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/amount_test_support.hpp"
#include "fields/distance_field.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using carpus::test::amount;
using ToolPose = Pose<frame::Bone, frame::Tool>;

const std::vector<InstrumentShape>& instruments() {
  static const std::vector<InstrumentShape> kAll{
      InstrumentShape(SphereShape{1.5}), InstrumentShape(CapsuleShape{1.0, 30}),
      InstrumentShape(ConeTipShape{0.57, 1.5, 40}),
      InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 16})};
  return kAll;
}

/// A surface, its field and the oracle.
struct Body {
  explicit Body(const TriangleMesh& surface, double spacing_mm = 0.6)
      : mesh(surface),
        field(fields::build_distance_field(mesh, {.spacing_mm = spacing_mm, .band_mm = 4}), mesh),
        exact(mesh) {}
  TriangleMesh mesh;
  fields::ContactField field;
  fields::ExactSurface exact;
};

const Body& ring() {
  static const Body kRing(fields::test::torus(8, 3, 24));
  return kRing;
}
const Body& cup() {
  static const Body kCup(fields::test::bowl(24));
  return kCup;
}
const Body& slab() {
  static const Body kSlab(fields::test::box({12, 8, 5}));
  return kSlab;
}

/// A pose whose axis passes near the surface: within 3 mm of a vertex.
ToolPose pose_near(const Body& body, const InstrumentShape& shape, Rng& rng) {
  const Vec3 vertex = body.mesh.vertices[rng.below(body.mesh.vertices.size())];
  const Vec3 shaft = fields::test::random_direction(rng);
  const Vec3 centre = vertex + fields::test::random_shift(rng, 3);
  const double z = rng.uniform(shape.front_z_mm(), shape.back_z_mm());
  return {fields::test::turned_to(shaft), centre - shaft * z};
}

/// What must hold of an answer, against the triangles.
void expect_true_contact(const Body& body, const InstrumentShape& shape, const ToolPose& pose) {
  const SurfaceContact contact = find_contact(body.field, shape, pose, 2.0);
  constexpr double kTolerance = 2e-3;  // of the oracle, which errs upwards
  const double truth = body.exact.gap_of(shape, pose, kTolerance).gap_mm;
  ASSERT_NE(contact.outcome, ContactOutcome::NotKnown);
  ASSERT_GE(truth, contact.lowest_gap_mm - 1e-6);
  ASSERT_LE(truth, contact.highest_gap_mm + kTolerance);
  if (contact.outcome == ContactOutcome::Far) return;
  if (contact.outcome != ContactOutcome::Buried) {
    ASSERT_LE(std::abs(truth - contact.gap_mm), body.field.error_mm() + kTolerance);
    ASSERT_LE(contact.highest_gap_mm - contact.lowest_gap_mm, 2 * body.field.error_mm() + 1e-9);
  }
  ASSERT_GE(contact.z_mm, shape.front_z_mm());
  ASSERT_LE(contact.z_mm, shape.back_z_mm() + 1e-9);
}

TEST(InstrumentContact, LiesWithinItsBoundsForAnyPose) {
  Rng rng(1);
  for (const Body* body : {&ring(), &cup(), &slab()}) {
    for (const InstrumentShape& shape : instruments()) {
      for (int i = 0; i < amount(10, 40, 3000); ++i) {
        expect_true_contact(*body, shape, pose_near(*body, shape, rng));
      }
    }
  }
}

TEST(InstrumentContact, LiesWithinItsBoundsGrazingTheSurface) {
  // Balls that touch with gaps of a hundredth of a millimetre to either side.
  Rng rng(2);
  for (const Body* body : {&ring(), &cup()}) {
    for (const InstrumentShape& shape : instruments()) {
      for (int i = 0; i < amount(5, 25, 2000); ++i) {
        ToolPose pose = pose_near(*body, shape, rng);
        const SurfaceContact first = find_contact(body->field, shape, pose, 2.0);
        if (!(length(first.normal.v) > 0.5)) continue;
        pose.translation += first.normal.v * (rng.uniform(-0.01, 0.01) - first.gap_mm);
        expect_true_contact(*body, shape, pose);
      }
    }
  }
}

TEST(InstrumentContact, FindsTheLeastGapOfTheFieldItself) {
  Rng rng(3);
  for (const Body* body : {&ring(), &cup()}) {
    for (const InstrumentShape& shape : instruments()) {
      for (int i = 0; i < amount(20, 100, 4000); ++i) {
        const ToolPose pose = pose_near(*body, shape, rng);
        const SurfaceContact contact = find_contact(body->field, shape, pose, 2.0);
        constexpr int kSteps = 800;
        double least = 2.0;
        for (int s = 0; s <= kSteps; ++s) {
          const double z =
              shape.front_z_mm() + (shape.back_z_mm() - shape.front_z_mm()) * s / kSteps;
          const Vec3 p = pose.translation + pose.rotation.column(2) * z;
          least = std::min(least, body->field.sample(p) - shape.radius_at(z));
        }
        if (contact.outcome == ContactOutcome::Far) {
          ASSERT_EQ(least, 2.0);
          continue;
        }
        const double step = (shape.back_z_mm() - shape.front_z_mm()) / kSteps;
        ASSERT_LE(contact.gap_mm, least + 1e-6);
        ASSERT_GE(contact.gap_mm, least - 2.5 * step - 1e-6);
      }
    }
  }
}

TEST(InstrumentContact, MeasuresABarThatLiesOnASlab) {
  // Half the bar over the slab's top, 0.3 mm deep; the slab's edge is at x = 12.
  const InstrumentShape bar(CapsuleShape{1.0, 30});
  const ToolPose pose{fields::test::turned_to({1, 0, 0}), {2, 0, 5.7}};
  const SurfaceContact contact = find_contact(slab().field, bar, pose);
  ASSERT_EQ(contact.outcome, ContactOutcome::Touching);
  EXPECT_NEAR(contact.depth_mm(), 0.3, 1e-3);
  EXPECT_NEAR(contact.normal.v.z, 1, 1e-2);
  EXPECT_NEAR(contact.point.v.z, 5, 1e-3);
  EXPECT_LE(contact.lowest_gap_mm, -0.3);
  EXPECT_GE(contact.highest_gap_mm, -0.3);
  ASSERT_EQ(contact.patch.stretch_count, 1);
  const ContactStretch& stretch = contact.patch.stretches[0];
  EXPECT_NEAR(stretch.from_mm, 1, 1e-9);   // the first ball's centre
  EXPECT_NEAR(stretch.to_mm, 10.7, 0.25);  // sqrt(1 - 0.7^2) past the edge
  EXPECT_NEAR(contact.patch.length_mm, stretch.to_mm - stretch.from_mm, 1e-9);
  EXPECT_NEAR(contact.patch.centre_z_mm, 5.6, 0.3);
  EXPECT_NEAR(contact.patch.area_mm2, 2 * std::sqrt(1 - 0.49) * 9.5, 0.7);
}

TEST(InstrumentContact, CountsTurnsAndTellsWhereTheCoreTouches) {
  const InstrumentShape screw(ThreadedCylinderShape{1.0, 1.5, 0.8, 16});
  const SurfaceContact crest =
      find_contact(slab().field, screw, {fields::test::turned_to({1, 0, 0}), {-8, 0, 6.3}});
  EXPECT_NEAR(crest.depth_mm(), 0.2, 1e-3);
  EXPECT_NEAR(crest.patch.length_mm, 13, 1e-6);
  EXPECT_NEAR(crest.patch.thread_turns, 13 / 0.8, 1e-6);
  EXPECT_EQ(crest.patch.core_length_mm, 0);
  const SurfaceContact core =
      find_contact(slab().field, screw, {fields::test::turned_to({1, 0, 0}), {-8, 0, 5.9}});
  EXPECT_NEAR(core.depth_mm(), 0.6, 1e-3);
  EXPECT_NEAR(core.patch.core_length_mm, 13, 1e-6);
  EXPECT_EQ(find_contact(slab().field, instruments()[1], {}).patch.thread_turns, 0);
}

TEST(InstrumentContact, TellsTheStretchesOfABarAcrossHollows) {
  // Across the ring it touches the tube twice, over the bowl both rims: a hull would fill these.
  const InstrumentShape bar(CapsuleShape{1.0, 40});
  for (const auto& [body, height] : {std::pair{&ring(), 3.8}, std::pair{&cup(), 4.3}}) {
    const ToolPose pose{fields::test::turned_to({1, 0, 0}), {-20, 0, height}};
    const SurfaceContact contact = find_contact(body->field, bar, pose);
    ASSERT_EQ(contact.outcome, ContactOutcome::Touching);
    ASSERT_EQ(contact.patch.stretch_count, 2);
    EXPECT_EQ(contact.patch.stretches_found, 2);
    const auto& [left, right] = std::pair{contact.patch.stretches[0], contact.patch.stretches[1]};
    EXPECT_NEAR(left.depth_mm, 0.2, 0.05);
    EXPECT_NEAR(right.depth_mm, 0.2, 0.05);
    EXPECT_LT(left.to_mm, 20 - 5);
    EXPECT_GT(right.from_mm, 20 + 5);
    EXPECT_NEAR(contact.patch.centre_z_mm, 20, 0.5);
    EXPECT_NEAR(left.normal.v.z, 1, 0.05);
  }
  const ToolPose between{fields::test::turned_to({1, 0, 0}), {-5, 0, 3.8}};
  const InstrumentShape brief(CapsuleShape{0.5, 10});
  EXPECT_FALSE(find_contact(ring().field, brief, between).has_contact());
}

TEST(InstrumentContact, KeepsTheDeepestOfManyStretches) {
  // A comb of seven ridges, each 0.05 mm higher than the one before.
  TriangleMesh comb;
  for (int i = 0; i < 7; ++i) {
    TriangleMesh ridge = fields::test::box({0.6, 3, 2});
    const auto first = static_cast<std::uint32_t>(comb.vertices.size());
    for (const Vec3& v : ridge.vertices) {
      comb.vertices.push_back(v + Vec3{4.0 * (i - 3), 0, v.z > 0 ? 0.05 * i : 0});
    }
    for (const auto& [a, b, c] : ridge.facets) {
      comb.facets.push_back({first + a, first + b, first + c});
    }
  }
  const Body body(comb, 0.4);
  const InstrumentShape bar(CapsuleShape{1.0, 36});
  const SurfaceContact contact =
      find_contact(body.field, bar, {fields::test::turned_to({1, 0, 0}), {-18, 0, 2.8}});
  EXPECT_EQ(contact.patch.stretches_found, 7);
  ASSERT_EQ(contact.patch.stretch_count, kMaxStretches);
  for (std::size_t i = 0; i < kMaxStretches; ++i) {
    const double ridge = static_cast<double>(i) + 3;
    EXPECT_NEAR(contact.patch.stretches[i].depth_mm, 0.2 + 0.05 * ridge, 0.15);
    EXPECT_NEAR(contact.patch.stretches[i].z_mm, 18 + 4 * (ridge - 3), 0.7);
  }
}

TEST(InstrumentContact, TouchesWithinTheShape) {
  Rng rng(4);
  int touching = 0;
  for (const InstrumentShape& shape : instruments()) {
    for (int i = 0; i < amount(50, 300, 5000); ++i) {
      const ToolPose pose = pose_near(cup(), shape, rng);
      const SurfaceContact contact = find_contact(cup().field, shape, pose);
      for (std::size_t s = 0; s < contact.patch.stretch_count; ++s) {
        const ContactStretch& stretch = contact.patch.stretches[s];
        ASSERT_LE(stretch.from_mm, stretch.z_mm + 1e-6);
        ASSERT_LE(stretch.z_mm, stretch.to_mm + 1e-6);
        ASSERT_LE(stretch.depth_mm, contact.depth_mm());
        const double radius = shape.radius_at(stretch.z_mm);
        if (stretch.depth_mm > 2 * radius) continue;  // sunk wholly: the surface is beyond it
        const Vec3 in_tool = (pose.inverse() * stretch.point).v;
        ASSERT_LE(shape.signed_distance(in_tool), 1e-9);
        ++touching;
      }
      ASSERT_LE(contact.patch.length_mm, shape.back_z_mm() - shape.front_z_mm() + 1e-9);
    }
  }
  EXPECT_GT(touching, amount(20, 100, 100));
}

TEST(InstrumentContact, GoesDeeperWhenPushedAlongItsNormal) {
  Rng rng(5);
  int pushed = 0;
  for (const InstrumentShape& shape : instruments()) {
    for (int i = 0; i < amount(20, 200, 2000); ++i) {
      ToolPose pose = pose_near(cup(), shape, rng);
      const SurfaceContact first = find_contact(cup().field, shape, pose, 1.0);
      if (first.outcome != ContactOutcome::Near || first.steepness < 0.95) continue;
      double last = -first.gap_mm;
      for (int step = 0; step < 10; ++step) {
        pose.translation -= first.normal.v * 0.02;
        const double depth = -find_contact(cup().field, shape, pose, 1.0).gap_mm;
        // The ball that was nearest sinks; it may enter a hollow, so by a share of the way.
        ASSERT_GT(depth, last - 0.02);
        last = depth;
      }
      ASSERT_GT(last, -first.gap_mm + 0.1);
      ++pushed;
    }
  }
  EXPECT_GT(pushed, amount(0, 10, 10));
}

TEST(InstrumentContact, KeepsItsGapUnderRigidMotionUpToItsBounds) {
  const Mat3 turn = rotation_about(normalized_or({1, 2, 3}, {}), 0.7);
  const Vec3 shift{10.3, -7.7, 31.9};
  TriangleMesh moved = cup().mesh;
  for (Vec3& v : moved.vertices) v = turn * v + shift;
  const Body body(moved);
  Rng rng(6);
  for (const InstrumentShape& shape : instruments()) {
    for (int i = 0; i < amount(20, 100, 3000); ++i) {
      const ToolPose pose = pose_near(cup(), shape, rng);
      const ToolPose moved_pose{turn * pose.rotation, turn * pose.translation + shift};
      const SurfaceContact a = find_contact(cup().field, shape, pose, 2.0);
      const SurfaceContact b = find_contact(body.field, shape, moved_pose, 2.0);
      ASSERT_LE(a.lowest_gap_mm, b.highest_gap_mm);
      ASSERT_LE(b.lowest_gap_mm, a.highest_gap_mm);
    }
  }
}

TEST(InstrumentContact, NamesWhatItCannotTell) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const InstrumentShape& shape : instruments()) {
    ToolPose pose;
    pose.translation.y = nan;
    EXPECT_EQ(find_contact(ring().field, shape, pose).outcome, ContactOutcome::NotKnown);
    pose = {};
    pose.rotation.rows[1].z = std::numeric_limits<double>::infinity();
    EXPECT_EQ(find_contact(ring().field, shape, pose).outcome, ContactOutcome::NotKnown);
    for (const double far : {50.0, 1e9, 1e300}) {
      EXPECT_EQ(find_contact(ring().field, shape, {Mat3::identity(), {far, 0, -far}}).outcome,
                ContactOutcome::Far);
    }
  }
  const InstrumentShape thick(SphereShape{6});
  EXPECT_LT(greatest_gap_mm(ring().field, thick), 0);
  EXPECT_EQ(find_contact(ring().field, thick, {}).outcome, ContactOutcome::NotKnown);
  const Body block(fields::test::box({8, 8, 8}), 0.8);
  const SurfaceContact buried = find_contact(block.field, instruments()[0], {});
  EXPECT_EQ(buried.outcome, ContactOutcome::Buried);
  EXPECT_GE(buried.depth_mm(), 4 + 1.5 - 1e-6);
  EXPECT_TRUE(buried.has_contact());
}

TEST(InstrumentContact, AllocatesNothing) {
  Rng rng(7);
  const Body& body = cup();
  const auto shapes = instruments();
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 100; ++i) {
    for (const InstrumentShape& shape : shapes) {
      (void)find_contact(body.field, shape, pose_near(body, shape, rng), 2.0);
    }
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

}  // namespace
}  // namespace carpus::contact
