// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/bounding_volumes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::figures {
namespace {

TEST(BoundingVolumes, OfATiltedRectangleHaveTheAreasOfGeometry) {
  constexpr double kTilt = 0.5;  // rad
  std::vector<Vec2> points;
  for (const Vec2& p : {Vec2{-4, -1}, Vec2{4, -1}, Vec2{4, 1}, Vec2{-4, 1}, Vec2{0.3, 0.2}}) {
    points.push_back({std::cos(kTilt) * p.x - std::sin(kTilt) * p.y,
                      std::sin(kTilt) * p.x + std::cos(kTilt) * p.y});
  }
  const auto shapes = bounding_shapes(points);
  ASSERT_EQ(shapes.size(), 5U);
  EXPECT_NEAR(shapes[0].area, std::numbers::pi * 17, 1e-9);  // half a diagonal is sqrt(17)
  const double width = 8 * std::cos(kTilt) + 2 * std::sin(kTilt);
  const double height = 8 * std::sin(kTilt) + 2 * std::cos(kTilt);
  EXPECT_NEAR(shapes[1].area, width * height, 1e-9);
  EXPECT_NEAR(shapes[2].area, 16, 1e-9);
  EXPECT_NEAR(shapes[4].area, 16, 1e-12);
}

TEST(BoundingVolumes, EachHoldsTheHullAndTheOctagonLiesWithinTheAxesBox) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    std::vector<Vec2> points;
    for (int i = 0; i < 50; ++i) points.push_back({9 * rng.normal(), 4 * rng.normal()});
    const auto shapes = bounding_shapes(points);
    for (const BoundingShape& shape : shapes) {
      EXPECT_GE(shape.area, shapes.back().area * (1 - 1e-12)) << shape.name;
    }
    EXPECT_LE(shapes[3].area, shapes[1].area);
    EXPECT_LE(shapes[2].area, shapes[1].area * (1 + 1e-12));
  }
}

TEST(BoundingVolumes, WhatWastesIsSaid) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const std::string svg = draw_bounding_volumes(square);
  EXPECT_THAT(svg, testing::HasSubstr("57 % more area"));  // pi / 2 - 1
  EXPECT_THAT(svg, testing::HasSubstr("4 mm²"));
  EXPECT_THROW((void)bounding_shapes(std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}}), InvalidInput);
}

}  // namespace
}  // namespace carpus::figures
