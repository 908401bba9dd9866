// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/silhouette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "view_trainer/screw_test_support.hpp"

namespace carpus::view_trainer {
namespace {

const ScaphoidSurface& surface() {
  static const ScaphoidSurface one(test::wrist());
  return one;
}

TEST(Silhouette, EveryVertexOfTheBoneIsWithinTheOutline) {
  for (const StandardView& view : standard_views()) {
    const PosedView posed = pose_view(test::wrist(), view);
    const OutlineMap map = silhouette_of(surface(), posed);
    double greatest = -1e9;
    for (const Vec3& v : surface().fragments().front()->surface.vertices) {
      const auto p = fluoroscopy::project_point(
          posed.c_arm, posed.patient_from_scaphoid * Point<frame::Bone>{v});
      greatest = std::max(greatest, map.distance_at({p->x, p->y}));
    }
    EXPECT_NEAR(greatest, 0.0, 0.06) << view.id;
    ASSERT_EQ(map.outlines().size(), 1U) << view.id;
  }
}

TEST(Silhouette, TheScaphoidIsInTheMiddleOfEveryView) {
  for (const StandardView& view : standard_views()) {
    const PosedView posed = pose_view(test::wrist(), view);
    const auto outline = silhouette_of(surface(), posed).outlines().front();
    double x = 0;
    double y = 0;
    for (const Vec2& p : outline) {
      x += p.x / static_cast<double>(outline.size());
      y += p.y / static_cast<double>(outline.size());
    }
    EXPECT_NEAR(x, 255.5, 16) << view.id;
    EXPECT_NEAR(y, 255.5, 16) << view.id;
  }
}

TEST(Silhouette, ScrewInsideIsWithinTheOutlineAndOneOutAlongThePictureStandsOut) {
  const std::size_t lateral = view_index("lateral");
  const PosedView posed = pose_view(test::wrist(), standard_views()[lateral]);
  const OutlineMap map = silhouette_of(surface(), posed);
  EXPECT_LT(map.overhang_of(screw_outline(test::screw_at_distal_pole(-2.0), posed)), 0.0);
  const double one = map.overhang_of(screw_outline(test::screw_at_distal_pole(1.5), posed));
  const double two = map.overhang_of(screw_outline(test::screw_at_distal_pole(2.5), posed));
  EXPECT_GT(two, one);
  const double truth = surface().protrusion_of(test::screw_at_distal_pole(2.5)).depth_mm;
  EXPECT_LT(two, 1.04 * truth) << "a shadow is not longer than what casts it";
}

TEST(Silhouette, BrokenBoneHasOneOutlineInTheGap) {
  const cases::CaseData broken = test::broken_wrist();
  const ScaphoidSurface halves(broken);
  for (const StandardView& view : standard_views()) {
    const PosedView posed = pose_view(broken, view);
    const OutlineMap map = silhouette_of(halves, posed);
    const double overhang =
        map.overhang_of(screw_outline(test::short_screw_in_the_middle(), posed));
    EXPECT_LT(overhang, 0.05) << view.id << ": metal that crosses the gap does not stand out";
  }
}

TEST(OutlineMap, DistancesOfADiscAreThoseOfItsFormula) {
  OutlineMap map({{0, 0}, 400, 400, 0.125});
  map.add_disc({100, 100}, 48);
  map.finish();
  for (int i = 0; i < 360; i += 7) {
    const double angle = i * 0.01745329;
    for (const double radius : {20.0, 40.0, 48.0, 60.0, 90.0}) {
      const double d =
          map.distance_at({100 + radius * std::cos(angle), 100 + radius * std::sin(angle)});
      EXPECT_NEAR(d, (radius - 48) * 0.125, 0.05);
    }
  }
  const auto outlines = map.outlines();
  ASSERT_EQ(outlines.size(), 1U);
  for (const Vec2& p : outlines.front()) {
    EXPECT_NEAR(std::hypot(p.x - 100, p.y - 100), 48, 0.4);
  }
}

TEST(OutlineMap, OutlineFollowsAPolygonWithANotch) {
  OutlineMap map({{0, 0}, 300, 300, 0.125});
  map.add_polygon(
      {{20, 20}, {120, 20}, {120, 120}, {80, 120}, {80, 60}, {60, 60}, {60, 120}, {20, 120}});
  map.finish();
  EXPECT_LT(map.distance_at({40, 100}), 0);
  EXPECT_GT(map.distance_at({70, 100}), 1.0);
  EXPECT_EQ(map.outlines().size(), 1U);
  const Vec2 outwards = map.outwards_at({120, 60});
  EXPECT_GT(outwards.x, 0.9);
}

}  // namespace
}  // namespace carpus::view_trainer
