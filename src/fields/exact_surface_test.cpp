// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/exact_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/amount_test_support.hpp"
#include "core/error.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::fields {
namespace {

using carpus::test::amount;

TEST(ExactSurface, MeasuresASegmentToATriangleAsAScanDoes) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const auto point = [&] {
      return Vec3{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
    };
    const std::array<Vec3, 3> t{point(), point(), point()};
    const Vec3 a = point();
    const Vec3 b = point();
    double best = 1e9;
    constexpr int kSteps = 2000;
    for (int s = 0; s <= kSteps; ++s) {
      const Vec3 p = a + (b - a) * (static_cast<double>(s) / kSteps);
      best = std::min(best, distance(p, nearest_point_on_triangle(p, t[0], t[1], t[2])));
    }
    const double found = segment_triangle_distance(a, b, t);
    ASSERT_LE(found, best + 1e-12);
    ASSERT_NEAR(found, best, 0.5 * distance(a, b) / kSteps + 1e-12);
  }
}

TEST(ExactSurface, MeasuresDegenerateSegmentsAndTriangles) {
  const std::array<Vec3, 3> t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_DOUBLE_EQ(segment_triangle_distance({1, 1, 2}, {1, 1, 2}, t), 2);
  EXPECT_DOUBLE_EQ(segment_triangle_distance({1, 1, 2}, {1, 1, -2}, t), 0);
  EXPECT_DOUBLE_EQ(segment_triangle_distance({-1, 1, 3}, {5, 1, 3}, t), 3);
  EXPECT_DOUBLE_EQ(segment_triangle_distance({0, -2, 0}, {4, -2, 0}, t), 2);
  const std::array<Vec3, 3> point{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  EXPECT_DOUBLE_EQ(segment_triangle_distance({1, 1, 3}, {1, 1, 5}, point), 2);
}

TEST(ExactSurface, SignsByTheWindingNumber) {
  const ExactSurface ring(test::torus(8, 3, 40));
  EXPECT_NEAR(ring.signed_distance({8, 0, 0}), -3, 0.05);
  EXPECT_NEAR(ring.signed_distance({0, 0, 0}), 5, 0.05);
  const ExactSurface cup(test::bowl(40));
  EXPECT_NEAR(cup.signed_distance({0, 0, 1}), 2, 0.05);
  EXPECT_LT(cup.signed_distance({0, 0, -2}), -0.9);
  TriangleMesh open = test::torus(8, 3, 8);
  open.facets.pop_back();
  EXPECT_THROW(ExactSurface{open}, InvalidInput);
}

TEST(ExactSurface, FindsTheGapOfACapsuleThatAllTrianglesGive) {
  const InstrumentShape capsule(CapsuleShape{1.2, 18});
  const ExactSurface ring(test::torus(8, 3, 24));
  const ExactSurface cup(test::bowl(24));
  Rng rng(2);
  int apart = 0;
  for (int i = 0; i < amount(60, 200, 2000); ++i) {
    const ExactSurface& surface = i % 2 == 0 ? ring : cup;
    const Vec3 shaft = test::random_direction(rng);
    const Vec3 tip{rng.uniform(-14, 14), rng.uniform(-14, 14), rng.uniform(-12, 12)};
    const double to_axis =
        surface.gap_of(capsule, {test::turned_to(shaft), tip}, 1e-3).gap_mm + 1.2;
    const double by_all = surface.distance_to_segment(tip + shaft * 1.2, tip + shaft * 16.8);
    if (to_axis > 1e-2) {
      ++apart;
      ASSERT_NEAR(to_axis, by_all, 1.001e-3);
    } else {
      ASSERT_LT(by_all, std::abs(to_axis) + 1.1e-2);  // it crosses the surface, or lies in the bone
    }
  }
  EXPECT_GT(apart, 10);
}

TEST(ExactSurface, FindsTheDepthOfABall) {
  const ExactSurface surface(test::box({6, 5, 4}));
  const InstrumentShape ball(SphereShape{2});
  const Pose<frame::Bone, frame::Tool> pose{Mat3::identity(), {0, 0, 3}};
  EXPECT_NEAR(surface.gap_of(ball, pose).gap_mm, -1, 1e-12);  // its centre 1 mm over the top
  const Pose<frame::Bone, frame::Tool> inside{Mat3::identity(), {0, 0, 0}};
  EXPECT_NEAR(surface.gap_of(ball, inside).gap_mm, -4, 1e-12);  // its centre 2 mm under the top
}

}  // namespace
}  // namespace carpus::fields
