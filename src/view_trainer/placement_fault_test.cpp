// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/placement_fault.hpp"

#include <gtest/gtest.h>

#include "view_trainer/generated_screw.hpp"
#include "view_trainer/screw_test_support.hpp"
#include "view_trainer/seen_screw.hpp"
#include "view_trainer/silhouette.hpp"

namespace carpus::view_trainer {
namespace {

const ScaphoidSurface& surface() {
  static const ScaphoidSurface made(test::wrist());
  return made;
}

TEST(PlacementFault, OfAGeneratedScrewIsWhereAndAsFarAsItWasMade) {
  const ScaphoidSurface& scaphoid = surface();
  int out = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const GeneratedScrew screw = generate_screw(scaphoid, seed);
    const auto faults = faults_of(scaphoid, screw.placed);
    ASSERT_EQ(!faults.empty(), screw.is_out()) << seed;
    if (faults.empty()) continue;
    ++out;
    EXPECT_EQ(faults.front().region, screw.truth.region) << seed;
    EXPECT_NEAR(faults.front().depth_mm, screw.truth.depth_mm, 0.05) << seed;
  }
  EXPECT_GE(out, 8);
}

TEST(PlacementFault, EachEndOfAScrewThatIsTooLongIsTold) {
  const ScaphoidSurface& scaphoid = surface();
  const auto& axis = scaphoid.data().scaphoid.central_axis;
  const Vec3 shaft = normalized_or(axis.proximal - axis.distal, {0, 0, 1});
  const auto longest = test::screw_named("acutrak_standard_1994_30");
  PlacedScrew placed{longest, {}, shaft};
  placed.tip = (axis.proximal + axis.distal) / 2 - shaft * (placed.instrument().length_mm / 2);
  const auto faults = faults_of(scaphoid, placed);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_NE(faults[0].region, faults[1].region);
  EXPECT_GE(faults[0].depth_mm, faults[1].depth_mm);
}

TEST(PlacementFault, AViewShowsNoMoreThanThePartIsOutAndThanTheWholeScrewShows) {
  const ScaphoidSurface& scaphoid = surface();
  const auto views = standard_views();
  const CaseViews seen(scaphoid, {views.begin(), views.end()});
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const PlacedScrew placed = generate_screw(scaphoid, seed).placed;
    for (const PlacementFault& fault : faults_of(scaphoid, placed)) {
      for (std::size_t i = 0; i < views.size(); ++i) {
        const double shown = overhang_of(fault, placed, seen.at(i).truth, seen.at(i).posed);
        EXPECT_LE(shown, seen.overhang_of(placed, i).true_mm + 0.05) << views[i].id;
        EXPECT_LE(shown, fault.depth_mm + 0.15) << views[i].id;
      }
    }
  }
}

}  // namespace
}  // namespace carpus::view_trainer
