// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Against closed forms on the synthetic wrist, whose scaphoid is an ellipsoid.
#include "view_trainer/scaphoid_surface.hpp"

#include <gtest/gtest.h>

#include "cases/synthetic_case_test_support.hpp"
#include "core/rng.hpp"
#include "view_trainer/screw_test_support.hpp"

namespace carpus::view_trainer {
namespace {

const ScaphoidSurface& surface() {
  static const ScaphoidSurface one(test::wrist());
  return one;
}

TEST(ScaphoidSurface, SignAgreesWithWindingNumbersEverywhere) {
  const fields::ExactSurface exact(surface().fragments().front()->surface);
  Rng rng(5);
  const Vec3 centre = cases::test::synthetic_scaphoid().centre;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = centre + Vec3{rng.uniform(-16, 16), rng.uniform(-16, 16), rng.uniform(-16, 16)};
    ASSERT_NEAR(surface().signed_distance(p), exact.signed_distance(p), 1e-9);
  }
}

TEST(ScaphoidSurface, ScrewThroughThePoleIsOutByAsMuchAsItsRimIs) {
  for (const double out : {-2.0, -0.5, 0.0, 0.4, 1.0, 2.5}) {
    const PlacedScrew placed = test::screw_at_distal_pole(out);
    const Protrusion truth = surface().protrusion_of(placed);
    EXPECT_NEAR(truth.depth_mm, test::deepest_by_brute_force(surface(), placed), 0.01) << out;
    EXPECT_NEAR(surface().signed_distance(truth.at), truth.depth_mm, 1e-9);
    EXPECT_EQ(truth.region, Region::Distal);
  }
}

TEST(ScaphoidSurface, ThreadBesideTheWaistIsASide) {
  const cases::CaseData data = test::wrist_with_a_narrow_waist();
  const ScaphoidSurface narrow(data);
  const PlacedScrew placed = test::short_screw_in_the_middle();
  const Protrusion truth = narrow.protrusion_of(placed);
  EXPECT_EQ(truth.region, Region::Side);
  EXPECT_GT(truth.depth_mm, 0.3);
  EXPECT_NEAR(truth.depth_mm, test::deepest_by_brute_force(narrow, placed), 0.01);
}

TEST(ScaphoidSurface, GapOfABrokenBoneIsInside) {
  const cases::CaseData broken = test::broken_wrist();
  const ScaphoidSurface halves(broken);
  ASSERT_EQ(halves.fragments().size(), 2U);
  EXPECT_GT(halves.gap_points().size(), 100U);
  const Vec3 centre = cases::test::synthetic_scaphoid().centre;
  EXPECT_LT(halves.signed_distance(centre), -3.0) << "in the gap, as deep as in the whole bone";
  const PlacedScrew across = test::short_screw_in_the_middle();
  EXPECT_NEAR(halves.protrusion_of(across).depth_mm, surface().protrusion_of(across).depth_mm,
              0.15);
}

TEST(ScaphoidSurface, NamesTheBoneBesideTheScrew) {
  const auto trapezium = surface().data().bones[4];
  EXPECT_EQ(surface().neighbour_at(trapezium.surface.vertices.front()), "trapezium");
  EXPECT_EQ(surface().neighbour_at({500, 0, 0}), "");
}

}  // namespace
}  // namespace carpus::view_trainer
