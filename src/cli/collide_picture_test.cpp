// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_picture.hpp"
#include "survey/methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/stroke_text.hpp"
#include "hull/fast_hull.hpp"

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

/// Pixels that are more red than blue and green by far: the marks.
std::ptrdiff_t marked_pixels(const Picture& picture) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    const int red = picture.rgb[i];
    count += red > picture.rgb[i + 1] + 120 && red > picture.rgb[i + 2] + 110 ? 1 : 0;
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

TEST(CollidePicture, MarksTheNearestPointsTheDepthAndTheSweep) {
  const CollideBody first = cube_at({});
  for (const Vec3& place : {Vec3{4, 0.5, 0}, Vec3{1.5, 0.5, 0}}) {
    const CollideBody second = cube_at(place);
    const CollideReport report = collide(first, second, nullptr, Vec3{-1, 0, 0});
    const Picture picture = draw_collision(first, second, report);
    EXPECT_EQ(picture.rgb.size(), std::size_t{3} * picture.width * picture.height);
    EXPECT_GT(marked_pixels(picture), 300);
    CollideReport bare = report;
    bare.closest.reset();
    bare.penetration.reset();
    EXPECT_LT(marked_pixels(draw_collision(first, second, bare)), marked_pixels(picture));
  }
}

TEST(StrokeText, DrawsEveryLetterWithinItsWidth) {
  constexpr std::string_view kText =
      "The quick brown fox: 0.123, 45-6 (789) JUMPS over_lazy/dogs+=;";
  Canvas canvas(1200, 60);
  draw_text(canvas, 10, 40, 15, {0, 0, 0}, kText);
  const Picture picture = canvas.picture();
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    if (picture.rgb[i] < 100) last = std::max(last, static_cast<std::uint32_t>(i / 3) % 1200);
  }
  EXPECT_GT(last, 10 + text_width(15, kText) - 16);
  EXPECT_LT(last, 10 + text_width(15, kText));
}

}  // namespace
}  // namespace carpus::cli
