// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/swept_tool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/rng.hpp"

namespace carpus {
namespace {

using ToolPose = Pose<frame::Bone, frame::Tool>;

const std::vector<InstrumentShape>& shapes() {
  static const std::vector<InstrumentShape> kAll{
      InstrumentShape(SphereShape{1.5}), InstrumentShape(CapsuleShape{1.0, 12}),
      InstrumentShape(ConeTipShape{0.57, 1.5, 14}),
      InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 10})};
  return kAll;
}

Vec3 direction(Rng& rng) {
  return normalized_or({rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}, {0, 0, 1});
}
ToolPose pose_along(const Vec3& shaft, const Vec3& tip) {
  const Vec3 x = any_perpendicular(shaft);
  return {Mat3::from_columns(x, cross(shaft, x), shaft), tip};
}

TEST(SweptTool, IsTheShapeAtEveryPlaceOfTheWay) {
  Rng rng(1);
  for (const InstrumentShape& shape : shapes()) {
    for (int n = 0; n < 200; ++n) {
      const Vec3 shaft = direction(rng);
      const double travel = rng.uniform(0, 6);
      const ToolPose last = pose_along(shaft, {1, 2, 3});
      const SweptTool swept = SweptTool::whole(shape, last, travel);
      ASSERT_TRUE(swept.is_sound());
      const Vec3 p = last.translation + shaft * rng.uniform(-3, 20) + direction(rng) * 2.0;
      double least = std::numeric_limits<double>::infinity();
      constexpr int kSteps = 600;
      for (int i = 0; i <= kSteps; ++i) {
        ToolPose pose = last;
        pose.translation += shaft * (travel * i / kSteps);
        least = std::min(least, shape.signed_distance((pose.inverse() * Point<frame::Bone>{p}).v));
      }
      ASSERT_LE(swept.signed_distance(p), least + 1e-9);
      ASSERT_GE(swept.signed_distance(p), least - travel / kSteps);
    }
  }
}

TEST(SweptTool, AddsTheWholeByItsAdvances) {
  Rng rng(2);
  for (const InstrumentShape& shape : shapes()) {
    for (int n = 0; n < 200; ++n) {
      const Vec3 shaft = direction(rng);
      const ToolPose before = pose_along(shaft, {0, 0, 0});
      const ToolPose after = pose_along(shaft, shaft * -0.7);
      const SweptTool advance = SweptTool::advance(shape, after, 0.7);
      EXPECT_TRUE(advance.is_back_known());
      const Vec3 p = shaft * rng.uniform(-3, 14) + direction(rng) * 2.0;
      const double both =
          std::min(SweptTool::whole(shape, before).signed_distance(p), advance.signed_distance(p));
      ASSERT_NEAR(SweptTool::whole(shape, after, 0.7).signed_distance(p), both, 1e-9);
    }
  }
}

TEST(SweptTool, IsTheHullOfTwoBalls) {
  Rng rng(3);
  for (int n = 0; n < 500; ++n) {
    const Vec3 a = direction(rng) * 2.0;
    const Vec3 b = direction(rng) * 4.0;
    const double ra = rng.uniform(0, 2);
    const double rb = rng.uniform(0, 2);
    const SweptTool bar = SweptTool::bar(a, ra, b, rb);
    const Vec3 p = direction(rng) * rng.uniform(0, 6);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 2000; ++i) {
      const double s = i / 2000.0;
      least = std::min(least, distance(p, a + (b - a) * s) - (ra + (rb - ra) * s));
    }
    ASSERT_NEAR(bar.signed_distance(p), least, 5e-3);
    ASSERT_LE(bar.signed_distance(p), least + 1e-9);
  }
}

TEST(SweptTool, GrowsBySameWayEverywhereWhenWidened) {
  Rng rng(5);
  for (const InstrumentShape& shape : shapes()) {
    const SweptTool tool = SweptTool::advance(shape, pose_along(direction(rng), {1, 1, 1}), 0.5);
    for (int n = 0; n < 100; ++n) {
      const Vec3 p = direction(rng) * rng.uniform(0, 10);
      ASSERT_NEAR(tool.widened(0.2).signed_distance(p), tool.signed_distance(p) - 0.2, 1e-12);
    }
    EXPECT_TRUE(tool.widened(0.2).is_back_known());
    EXPECT_FALSE(tool.widened(-0.1).is_sound());
  }
}

TEST(SweptTool, LiesInItsBox) {
  Rng rng(4);
  for (const InstrumentShape& shape : shapes()) {
    for (int n = 0; n < 500; ++n) {
      const SweptTool swept = SweptTool::whole(shape, pose_along(direction(rng), {1, 1, 1}), 2);
      const Vec3 p = direction(rng) * rng.uniform(0, 18);
      const bool is_in_box = swept.bounds().grown(1e-9).contains(p);
      ASSERT_TRUE(is_in_box || swept.signed_distance(p) > 0);
    }
  }
}

TEST(SweptTool, IsNotSoundOfWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(SweptTool::bar({0, nan, 0}, 1, {0, 0, 1}, 1).is_sound());
  EXPECT_FALSE(SweptTool::bar({0, 0, 0}, 1, {0, nan, 1}, 1).is_sound());
  EXPECT_FALSE(SweptTool::bar({0, 0, 0}, -1, {0, 0, 9}, 1).is_sound());
  EXPECT_FALSE(SweptTool::bar({0, 0, 0}, 1, {0, 0, 9}, nan).is_sound());
  EXPECT_FALSE(SweptTool::whole(shapes()[0], {}, nan).is_sound());
  EXPECT_FALSE(SweptTool::advance(shapes()[0], {}, -1).is_sound());
  ToolPose pose;
  pose.rotation.rows[2].z = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(SweptTool::whole(shapes()[0], pose).is_sound());
  EXPECT_TRUE(SweptTool::bar({1, 1, 1}, 1, {1, 1, 1}, 1).is_sound());
  EXPECT_TRUE(SweptTool::whole(shapes()[2], {}).is_sound());
}

}  // namespace
}  // namespace carpus
