// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/contact_on_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/allocation_test_support.hpp"
#include "core/amount_test_support.hpp"
#include "fields/distance_field.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using carpus::test::amount;
using ToolPose = Pose<frame::Bone, frame::Tool>;

TEST(ContactOnTriangles, PutsTheContactOnTheTrianglesAndKeepsTheBounds) {
  const TriangleMesh mesh = fields::test::bowl(24);
  const fields::ContactField field(
      fields::build_distance_field(mesh, {.spacing_mm = 0.6, .band_mm = 4}), mesh);
  const fields::ExactSurface exact(mesh);
  const InstrumentShape bar(CapsuleShape{1.5, 24});
  Rng rng(1);
  int put = 0;
  for (int i = 0; i < amount(40, 150, 3000); ++i) {
    const Vec3 shaft = fields::test::random_direction(rng);
    const Vec3 centre =
        mesh.vertices[rng.below(mesh.vertices.size())] + fields::test::random_shift(rng, 2.5);
    const ToolPose pose{fields::test::turned_to(shaft), centre - shaft * rng.uniform(1.5, 22.5)};
    SurfaceContact contact = find_contact(field, bar, pose, 1.0);
    const SurfaceContact before = contact;
    carpus::test::start_counting_allocations();
    const bool is_put = put_on_triangles(exact.tree(), field, bar, pose, contact);
    ASSERT_EQ(carpus::test::stop_counting_allocations(), 0);
    if (!is_put) continue;
    ++put;
    const Vec3 ball = (pose * Point<frame::Tool>{{0, 0, contact.z_mm}}).v;
    ASSERT_NEAR(contact.gap_mm, exact.signed_distance(ball) - 1.5, 1e-9);
    ASSERT_NEAR(exact.signed_distance(contact.point.v), 0, 1e-9);
    ASSERT_NEAR(length(contact.normal.v), 1, 1e-9);
    ASSERT_EQ(contact.has_contact(), contact.gap_mm <= 0);
    // What the field proved holds, and what is told now is nearer to the truth from above.
    ASSERT_LE(contact.gap_mm, before.highest_gap_mm + 1e-9);
    ASSERT_GE(contact.gap_mm, contact.lowest_gap_mm - 1e-9);
    const double truth = exact.gap_of(bar, pose, 2e-3).gap_mm;
    ASSERT_LE(truth, contact.gap_mm + 2e-3);
    ASSERT_GE(truth, contact.lowest_gap_mm - 1e-9);
  }
  EXPECT_GT(put, amount(5, 50, 1000));
}

TEST(ContactOnTriangles, LeavesContactsAloneWhoseSideIsNotProved) {
  const TriangleMesh mesh = fields::test::box({6, 6, 6});
  const fields::ContactField field(
      fields::build_distance_field(mesh, {.spacing_mm = 0.8, .band_mm = 4}), mesh);
  const fields::TriangleTree tree(mesh);
  const InstrumentShape wire(ConeTipShape{0.57, 1.5, 40});
  SurfaceContact contact;
  EXPECT_FALSE(put_on_triangles(tree, field, wire, {}, contact));
  EXPECT_EQ(contact.outcome, ContactOutcome::NotKnown);
  const ToolPose tip{Mat3::identity(), {0, 0, 5.9}};  // the very tip, 0.1 mm in the top
  contact = find_contact(field, wire, tip);
  EXPECT_EQ(contact.outcome, ContactOutcome::Touching);
  EXPECT_FALSE(put_on_triangles(tree, field, wire, tip, contact));
  EXPECT_NEAR(contact.depth_mm(), 0.1, 1e-3);
}

}  // namespace
}  // namespace carpus::contact
