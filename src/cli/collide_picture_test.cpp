// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "hull/fast_hull.hpp"
#include "survey/methods.hpp"

namespace carpus::cli {
namespace {

CollideBody cube_at(const Vec3& place) {
  std::vector<Vec3> corners(8);
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0,
                  (i & 4U) != 0 ? 1.0 : -1.0};
  }
  return {"cube",
          convex::ConvexBody(hull::build_fast_hull(corners).polytope),
          {Mat3::identity(), place}};
}

/// How often the colour of the marks is used.
std::size_t marks(const std::string& picture) {
  std::size_t count = 0;
  for (std::size_t at = picture.find("#cc1a26"); at != std::string::npos;
       at = picture.find("#cc1a26", at + 1)) {
    ++count;
  }
  return count;
}

TEST(CollideReport, AnswersInTheCommonFrame) {
  const CollideBody first = cube_at({10, 0, 0});
  const CollideReport apart = collide(first, cube_at({14, 0, 0}), nullptr, Vec3{-4, 0, 0});
  EXPECT_EQ(apart.verdict, convex::Verdict::Apart);
  const convex::Closest closest = apart.closest.value_or(convex::Closest{});
  EXPECT_NEAR(closest.distance_mm, 2, 1e-12);
  EXPECT_NEAR(closest.on_first.x, 11, 1e-12);
  EXPECT_NEAR(apart.sweep.t_min_s, 0.5, 1e-12);
  EXPECT_NEAR(apart.sweep.first.point.x, 11, 1e-12);

  const CollideReport meet = collide(first, cube_at({11.5, 0, 0}), nullptr, {});
  EXPECT_EQ(meet.verdict, convex::Verdict::Meet);
  const convex::Penetration depth = meet.penetration.value_or(convex::Penetration{});
  EXPECT_NEAR(depth.depth_mm, 0.5, 1e-9);
  EXPECT_NEAR(depth.direction.x, 1, 1e-9);
}

TEST(CollideReport, SaysWhatAChosenMethodDoesNotGive) {
  const survey::Method* ivri = survey::find_method("ivri");
  const CollideReport report = collide(cube_at({}), cube_at({5, 0, 0}), ivri, {});
  EXPECT_EQ(report.method, ivri);
  EXPECT_EQ(report.distance_method, nullptr);
  EXPECT_FALSE(report.closest.has_value());
}

TEST(CollidePicture, MarksTheNearestPointsOrTheDepth) {
  const CollideBody first = cube_at({});
  // A line, two points and a label; an arrow, a point, a label, and "meet" in the same colour.
  for (const Vec3& place : {Vec3{4, 0.5, 0}, Vec3{1.5, 0.5, 0}}) {
    const CollideBody second = cube_at(place);
    const CollideReport report = collide(first, second, nullptr, {});
    const std::string picture = draw_collision(first, second, report);
    EXPECT_EQ(marks(picture), 4U);
    CollideReport bare = report;
    bare.closest.reset();
    bare.penetration.reset();
    EXPECT_EQ(marks(draw_collision(first, second, bare)), place.x > 2 ? 0U : 1U);
  }
}

TEST(CollidePicture, TellsOfASweepWhereTheHullsWillMeet) {
  const CollideBody first = cube_at({});
  const CollideBody second = cube_at({4, 0.5, 0});
  const auto picture_at = [&](const Vec3& velocity) {
    return draw_collision(first, second, collide(first, second, nullptr, velocity));
  };
  EXPECT_THAT(picture_at({-1, 0, 0}), testing::HasSubstr(">cube at first contact</text>"));
  EXPECT_THAT(picture_at({0, 0, 1}), testing::Not(testing::HasSubstr("at first contact")));
}

TEST(CollidePicture, WritesNamesThatHoldSigns) {
  CollideBody first = cube_at({});
  first.name = "a<b & c";
  const CollideReport report = collide(first, first, nullptr, {});
  EXPECT_THAT(draw_collision(first, first, report), testing::HasSubstr(">a&lt;b &amp; c</text>"));
}

}  // namespace
}  // namespace carpus::cli
